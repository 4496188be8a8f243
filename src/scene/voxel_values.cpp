#include "scene/voxel_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "scene/scalar_dispatch.hpp"

namespace triptych::scene {
namespace {

template <typename Use>
decltype(auto) with_stored_type(StoredType type, Use&& use) {
  switch (type) {
    case StoredType::u8:
      return use(std::uint8_t{});
    case StoredType::i8:
      return use(std::int8_t{});
    case StoredType::u16:
      return use(std::uint16_t{});
    case StoredType::i16:
      return use(std::int16_t{});
    case StoredType::u32:
      return use(std::uint32_t{});
    case StoredType::i32:
      return use(std::int32_t{});
    case StoredType::u64:
      return use(std::uint64_t{});
    case StoredType::i64:
      return use(std::int64_t{});
    case StoredType::f32:
      return use(float{});
    case StoredType::f64:
      break;
  }
  return use(double{});
}

template <typename T>
T swapped(T value) {
  std::array<std::byte, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(T));
  std::ranges::reverse(bytes);
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

// Appends values to the voxels of a volume. The memory grows in large steps.
template <typename To>
class Voxels {
 public:
  explicit Voxels(VoxelBytes& bytes, std::size_t count) : bytes_(bytes), count_(count) {
    bytes_.reserve(count * sizeof(To));
  }
  void append(To value) {
    if (at_ == bytes_.size()) {
      constexpr std::size_t step = std::size_t{16} << 20U;
      bytes_.resize(std::min(at_ + step, count_ * sizeof(To)));
    }
    std::memcpy(bytes_.data() + at_, &value, sizeof(To));
    at_ += sizeof(To);
  }

 private:
  VoxelBytes& bytes_;
  std::size_t count_;
  std::size_t at_ = 0;
};

// Calls `use` with each value, in native byte order, and with the index of its component. Returns
// the number of bytes read.
template <typename From, typename Use>
std::uint64_t for_each_value(const ValueLayout& layout, std::uint64_t needed,
                             const ByteSource& source, Use&& use) {
  const bool swap = layout.big_endian != (std::endian::native == std::endian::big);
  std::vector<std::byte> piece(
      static_cast<std::size_t>(std::min<std::uint64_t>(needed, std::uint64_t{1} << 20U)));
  std::uint64_t done = 0;
  std::uint64_t in_block = 0;
  std::uint64_t component = 0;
  while (done < needed) {
    const auto wanted =
        static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), needed - done));
    const std::size_t got = source(std::span(piece).first(wanted));
    for (std::size_t at = 0; at + sizeof(From) <= got; at += sizeof(From)) {
      From value;
      std::memcpy(&value, piece.data() + at, sizeof(From));
      use(swap ? swapped(value) : value, component);
      if (++in_block < layout.block) continue;
      in_block = 0;
      component = component + 1 == layout.components ? 0 : component + 1;
    }
    done += got;
    if (got < wanted) break;
  }
  return done;
}

template <typename From, typename To>
std::uint64_t read_component(Volume& volume, const ValueLayout& layout, std::uint64_t wanted,
                             std::uint64_t needed, const ByteSource& source) {
  Voxels<To> voxels(volume.voxels, volume.voxel_count());
  return for_each_value<From>(layout, needed, source, [&](From value, std::uint64_t component) {
    if (component != wanted) return;
    if (layout.is_scaled()) {
      voxels.append(static_cast<To>(layout.slope * static_cast<double>(value) + layout.intercept));
    } else {
      voxels.append(static_cast<To>(value));
    }
  });
}

// Computes the Euclidean length of each voxel's components.
template <typename From, typename To>
std::uint64_t lengths(Volume& volume, const ValueLayout& layout, std::uint64_t needed,
                      const ByteSource& source) {
  Voxels<To> voxels(volume.voxels, volume.voxel_count());
  // One sum for each voxel of the current block (ValueLayout::block). Grows as values are read.
  std::vector<double> sums;
  std::size_t at = 0;
  return for_each_value<From>(layout, needed, source, [&](From value, std::uint64_t component) {
    const double scaled = layout.slope * static_cast<double>(value) + layout.intercept;
    if (at == sums.size()) sums.push_back(0);
    double& sum = sums[at];
    sum = (component == 0 ? 0 : sum) + scaled * scaled;
    if (component + 1 == layout.components) voxels.append(static_cast<To>(std::sqrt(sum)));
    at = at + 1 == layout.block ? 0 : at + 1;
  });
}

template <typename From, typename To>
void convert_in_place(Volume& volume, ScalarType type) {
  static_assert(sizeof(To) <= sizeof(From));
  const std::size_t count = volume.voxel_count();
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = static_cast<To>(load_scalar<From>(volume.voxels.data(), i));
    std::memcpy(volume.voxels.data() + i * sizeof(To), &value, sizeof(To));
  }
  volume.voxels.resize(count * sizeof(To));
  volume.type = type;
}

// Converts integers to doubles. This is necessary if floats cannot represent them exactly.
template <typename From>
void convert_to_doubles(Volume& volume) {
  if constexpr (sizeof(From) == sizeof(double)) {
    convert_in_place<From, double>(volume, ScalarType::f64);
  } else {
    const std::size_t count = volume.voxel_count();
    VoxelBytes wide;
    wide.resize(count * sizeof(double));
    for (std::size_t i = 0; i < count; ++i) {
      const auto value = static_cast<double>(load_scalar<From>(volume.voxels.data(), i));
      std::memcpy(wide.data() + i * sizeof(double), &value, sizeof(double));
    }
    volume.voxels = std::move(wide);
    volume.type = ScalarType::f64;
  }
}

// Converts wide integers to the smallest type that can represent all of them.
template <typename From>
void narrow(Volume& volume) {
  From lo = std::numeric_limits<From>::max();
  From hi = std::numeric_limits<From>::lowest();
  bool exact_floats = true;
  for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
    const auto value = load_scalar<From>(volume.voxels.data(), i);
    lo = std::min(lo, value);
    hi = std::max(hi, value);
    // The values are compared as doubles, because the float nearest to the largest integer does not
    // fit into the integer type.
    exact_floats = exact_floats &&
                   static_cast<double>(static_cast<float>(value)) == static_cast<double>(value);
  }
  const auto fits = [&]<typename To>(To /*zero*/) {
    return std::cmp_greater_equal(lo, std::numeric_limits<To>::lowest()) &&
           std::cmp_less_equal(hi, std::numeric_limits<To>::max());
  };
  if (fits(std::uint8_t{})) {
    convert_in_place<From, std::uint8_t>(volume, ScalarType::u8);
  } else if (fits(std::int8_t{})) {
    convert_in_place<From, std::int8_t>(volume, ScalarType::i8);
  } else if (fits(std::uint16_t{})) {
    convert_in_place<From, std::uint16_t>(volume, ScalarType::u16);
  } else if (fits(std::int16_t{})) {
    convert_in_place<From, std::int16_t>(volume, ScalarType::i16);
  } else if (exact_floats) {
    convert_in_place<From, float>(volume, ScalarType::f32);
  } else {
    convert_to_doubles<From>(volume);
  }
}

}  // namespace

std::size_t bytes_of(StoredType type) {
  return with_stored_type(type, [](auto zero) { return sizeof(zero); });
}

std::string_view name_of(StoredType type) {
  constexpr std::array<std::string_view, 10> names{"u8",  "i8",  "u16", "i16", "u32",
                                                   "i32", "u64", "i64", "f32", "f64"};
  return names.at(static_cast<std::size_t>(type));
}

std::optional<ScalarType> same_type(StoredType type) {
  switch (type) {
    case StoredType::u8:
      return ScalarType::u8;
    case StoredType::i8:
      return ScalarType::i8;
    case StoredType::u16:
      return ScalarType::u16;
    case StoredType::i16:
      return ScalarType::i16;
    case StoredType::f32:
      return ScalarType::f32;
    case StoredType::f64:
      return ScalarType::f64;
    default:
      return std::nullopt;
  }
}

bool is_plain(const ValueLayout& layout) {
  return layout.components == 1 && !layout.is_scaled() && same_type(layout.type).has_value();
}

std::optional<std::uint64_t> value_bytes(const Volume& volume, const ValueLayout& layout) {
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  std::uint64_t bytes = bytes_of(layout.type);
  const std::array<std::uint64_t, 4> factors{
      layout.components, static_cast<std::uint64_t>(volume.size[0]),
      static_cast<std::uint64_t>(volume.size[1]), static_cast<std::uint64_t>(volume.size[2])};
  for (const std::uint64_t factor : factors) {
    if (factor == 0 || bytes > most / factor) return std::nullopt;
    bytes *= factor;
  }
  return bytes;
}

void check_component(const Component& component, std::uint64_t components,
                     const std::filesystem::path& file) {
  if (component.magnitude || component.index < components) return;
  throw core::InputError(
      {.file = file.string()},
      fmt::format("the file has {} value{} per voxel; component {} (0-based) does not exist",
                  components, components == 1 ? "" : "s", component.index));
}

std::uint64_t read_values(Volume& volume, const ValueLayout& layout, const Component& component,
                          const ByteSource& source) {
  const std::uint64_t needed = value_bytes(volume, layout).value_or(0);
  const bool floats = layout.is_scaled() || component.magnitude;
  return with_stored_type(layout.type, [&](auto zero) {
    using From = decltype(zero);
    constexpr bool is_double = std::is_same_v<From, double>;
    using Float = std::conditional_t<is_double, double, float>;
    constexpr ScalarType float_type = is_double ? ScalarType::f64 : ScalarType::f32;
    std::uint64_t count = 0;
    if (component.magnitude) {
      count = lengths<From, Float>(volume, layout, needed, source);
    } else if (floats) {
      count = read_component<From, Float>(volume, layout, component.index, needed, source);
    } else {
      count = read_component<From, From>(volume, layout, component.index, needed, source);
    }
    volume.type = floats ? float_type : same_type(layout.type).value_or(ScalarType::f64);
    if constexpr (std::is_integral_v<From> && sizeof(From) > 2) {
      if (!floats && count == needed) narrow<From>(volume);
    }
    return count;
  });
}

}  // namespace triptych::scene
