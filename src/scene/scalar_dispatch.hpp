#pragma once
// Selects code that was compiled for the scalar type of a volume, because this type is known only
// at run time.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "scene/volume.hpp"

namespace triptych::scene {

// Calls `use` with a zero of the C++ type that stores scalars of type `type`, and returns the
// result of `use`.
template <typename Use>
decltype(auto) with_scalar_type(ScalarType type, Use&& use) {
  switch (type) {
    case ScalarType::u8:
      return use(std::uint8_t{});
    case ScalarType::i8:
      return use(std::int8_t{});
    case ScalarType::u16:
      return use(std::uint16_t{});
    case ScalarType::i16:
      return use(std::int16_t{});
    case ScalarType::f32:
      return use(float{});
    case ScalarType::f64:
      break;
  }
  return use(double{});
}

// Returns element `index` of untyped memory.
template <typename Scalar>
Scalar load_scalar(const std::byte* storage, std::size_t index) {
  Scalar value;
  std::memcpy(&value, storage + index * sizeof(Scalar), sizeof(Scalar));
  return value;
}

}  // namespace triptych::scene
