#include "scene/volume.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "scene/denormals.hpp"
#include "scene/exact_math.hpp"
#include "scene/half.hpp"
#include "scene/scalar_dispatch.hpp"

namespace triptych::scene {
namespace {

std::size_t count_of(const std::array<int, 3>& size) {
  return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
         static_cast<std::size_t>(size[2]);
}

// Maps values from a range to 0..1, clamped. NaN and empty ranges give 0. The result is never −0,
// so that equal fields are bit-identical.
class Normaliser {
 public:
  explicit Normaliser(const Volume& volume)
      : mapping_(volume.mapping),
        least_(volume.range_lo),
        most_(volume.range_hi),
        // Values are halved if hi − lo would overflow. Otherwise they are multiplied by 1, which
        // does not round.
        unit_(std::isfinite(most_ - least_) ? 1.0 : 0.5),
        lo_(transformed(least_)),
        extent_(transformed(most_) - lo_) {}

  [[nodiscard]] double operator()(double value) const {
    if (!(extent_ > 0) || !(value > least_)) return 0;
    if (value >= most_) return 1;
    const double x = (transformed(value) - lo_) / extent_;
    if (!(x > 0)) return 0;
    return x < 1 ? x : 1;
  }

 private:
  // With a logarithmic mapping, all values of the range are positive.
  [[nodiscard]] double transformed(double value) const {
    return mapping_ == Mapping::logarithmic ? logarithm(value) : value * unit_;
  }

  Mapping mapping_;
  double least_;
  double most_;
  double unit_;
  double lo_;
  double extent_;
};

// Converts element by element, in place if both types have the same size.
template <typename From, typename To, typename Convert>
VoxelBytes convert(VoxelBytes&& voxels, Convert&& each) {
  const std::size_t n = voxels.size() / sizeof(From);
  VoxelBytes converted;
  if constexpr (sizeof(From) != sizeof(To)) converted.resize(n * sizeof(To));
  VoxelBytes& out = sizeof(From) == sizeof(To) ? voxels : converted;
  for (std::size_t i = 0; i < n; ++i) {
    const To result = each(load_scalar<From>(voxels.data(), i));
    std::memcpy(out.data() + i * sizeof(To), &result, sizeof(To));
  }
  return std::move(out);
}

// The amount by which a signed integer type is shifted so that its values begin at 0. It is 0 for
// unsigned types.
template <typename From>
inline constexpr int shift_of = std::is_signed_v<From> ? -int{std::numeric_limits<From>::min()} : 0;

template <typename From, typename To>
void encode_exactly(Volume& volume, VoxelGrid& grid) {
  const double extent = volume.range_hi - volume.range_lo;
  grid.scale = extent > 0 ? 1 / extent : 0;
  grid.offset = extent > 0 ? (-shift_of<From> - volume.range_lo) / extent : 0;
  if constexpr (std::is_same_v<From, To>) {
    grid.data = std::move(volume.voxels);
  } else {
    grid.data = convert<From, To>(std::move(volume.voxels), [](From value) {
      return static_cast<To>(int{value} + shift_of<From>);
    });
  }
}

template <typename From, typename To>
void encode_rounded(Volume& volume, VoxelGrid& grid) {
  constexpr double steps = std::numeric_limits<To>::max();
  const Normaliser normalise(volume);
  grid.scale = 1 / steps;
  grid.offset = 0;
  grid.data = convert<From, To>(std::move(volume.voxels), [&](From value) {
    return static_cast<To>(std::floor(normalise(static_cast<double>(value)) * steps + 0.5));
  });
}

template <typename From>
void encode_float(Volume& volume, VoxelGrid& grid) {
  const Normaliser normalise(volume);
  grid.scale = 1;
  grid.offset = 0;
  grid.data = convert<From, float>(std::move(volume.voxels), [&](From value) {
    return without_denormal(static_cast<float>(normalise(static_cast<double>(value))));
  });
}

// Returns whether the normalised value of every voxel can be written as stored·scale + offset.
bool is_linear(const Volume& volume) {
  return volume.mapping == Mapping::linear && !volume.clipped;
}

// Returns the number that is subtracted from integers before they are stored as f16.
double whole_part_of_lower_end(const Volume& volume) {
  return std::floor(volume.range_lo);
}

template <typename From>
VoxelBytes halves_of(Volume& volume, const auto& stored) {
  return convert<From, Half>(std::move(volume.voxels), [&](From value) {
    const double wanted = stored(static_cast<double>(value));
    return to_half(wanted < least_normal_half ? 0 : wanted);
  });
}

template <typename From>
void encode_half(Volume& volume, VoxelGrid& grid) {
  if (fits_halves(volume)) {
    const double extent = volume.range_hi - volume.range_lo;
    const double lower = whole_part_of_lower_end(volume);
    grid.scale = extent > 0 ? 1 / extent : 0;
    grid.offset = extent > 0 ? (lower - volume.range_lo) / extent : 0;
    grid.data = halves_of<From>(volume, [&](double value) { return value - lower; });
    return;
  }
  constexpr double stored_one = 0x1.0p15;
  const Normaliser normalise(volume);
  grid.scale = 1 / stored_one;
  grid.offset = 0;
  grid.data = halves_of<From>(volume, [&](double value) { return normalise(value) * stored_one; });
}

template <typename From, typename To>
void encode_integers(Volume& volume, VoxelGrid& grid) {
  if constexpr (std::is_integral_v<From> && sizeof(From) <= sizeof(To)) {
    if (is_linear(volume)) return encode_exactly<From, To>(volume, grid);
  }
  encode_rounded<From, To>(volume, grid);
}

template <typename From>
void encode_from(Volume& volume, VoxelGrid& grid) {
  switch (grid.format) {
    case VoxelFormat::u8:
      return encode_integers<From, std::uint8_t>(volume, grid);
    case VoxelFormat::u16:
      return encode_integers<From, std::uint16_t>(volume, grid);
    case VoxelFormat::f32:
      return encode_float<From>(volume, grid);
    case VoxelFormat::f16:
      return encode_half<From>(volume, grid);
  }
}

std::string hash_of(const VoxelGrid& grid) {
  core::HashBuilder hash("voxels");
  hash.add(name_of(grid.format));
  for (const int size : grid.size) hash.add(size);
  for (const double spacing : grid.spacing) hash.add(spacing);
  return hash.add(grid.scale).add(grid.offset).add_array(std::span(grid.data)).hash();
}

}  // namespace

std::size_t bytes_of(ScalarType type) {
  return with_scalar_type(type, [](auto zero) { return sizeof(zero); });
}

std::string_view name_of(ScalarType type) {
  switch (type) {
    case ScalarType::u8:
      return "u8";
    case ScalarType::i8:
      return "i8";
    case ScalarType::u16:
      return "u16";
    case ScalarType::i16:
      return "i16";
    case ScalarType::f32:
      return "f32";
    case ScalarType::f64:
      return "f64";
  }
  return {};
}

std::string_view name_of(Mapping mapping) {
  return mapping == Mapping::linear ? "linear" : "log";
}

std::size_t Volume::voxel_count() const noexcept {
  return count_of(size);
}

double Volume::value(std::size_t index) const {
  return with_scalar_type(type, [&](auto zero) {
    return static_cast<double>(load_scalar<decltype(zero)>(voxels.data(), index));
  });
}

std::string_view name_of(VoxelFormat format) {
  switch (format) {
    case VoxelFormat::u8:
      return "u8";
    case VoxelFormat::u16:
      return "u16";
    case VoxelFormat::f32:
      return "f32";
    case VoxelFormat::f16:
      return "f16";
  }
  return {};
}

VoxelFormat voxel_format(std::string_view name) {
  for (const auto format :
       {VoxelFormat::u8, VoxelFormat::u16, VoxelFormat::f32, VoxelFormat::f16}) {
    if (name_of(format) == name) return format;
  }
  throw core::InputError(
      fmt::format("unknown voxel format '{}'; expected u8, u16, f32 or f16", name));
}

std::size_t bytes_of(VoxelFormat format) {
  switch (format) {
    case VoxelFormat::u8:
      return 1;
    case VoxelFormat::u16:
    case VoxelFormat::f16:
      return 2;
    case VoxelFormat::f32:
      return 4;
  }
  return 0;
}

double largest_stored(VoxelFormat format) {
  switch (format) {
    case VoxelFormat::u8:
      return 255;
    case VoxelFormat::u16:
      return 65535;
    case VoxelFormat::f32:
    case VoxelFormat::f16:
      return 1;
  }
  return 1;
}

std::size_t VoxelGrid::voxel_count() const noexcept {
  return count_of(size);
}

double VoxelGrid::normalised(std::size_t index) const {
  switch (format) {
    case VoxelFormat::u8:
      return load_scalar<std::uint8_t>(data.data(), index) * scale + offset;
    case VoxelFormat::u16:
      return load_scalar<std::uint16_t>(data.data(), index) * scale + offset;
    case VoxelFormat::f32:
      return static_cast<double>(load_scalar<float>(data.data(), index)) * scale + offset;
    case VoxelFormat::f16:
      return static_cast<double>(load_scalar<Half>(data.data(), index)) * scale + offset;
  }
  return 0;
}

VoxelFormat lossless_format(ScalarType type) {
  switch (type) {
    case ScalarType::u8:
    case ScalarType::i8:
      return VoxelFormat::u8;
    case ScalarType::u16:
    case ScalarType::i16:
      return VoxelFormat::u16;
    case ScalarType::f32:
    case ScalarType::f64:
      return VoxelFormat::f32;
  }
  return VoxelFormat::f32;
}

VoxelFormat lossless_format(const Volume& volume) {
  return is_linear(volume) ? lossless_format(volume.type) : VoxelFormat::f32;
}

bool fits_halves(const Volume& volume) {
  if (!is_linear(volume)) return false;
  return with_scalar_type(volume.type, [&]<typename Scalar>(Scalar) {
    if constexpr (std::is_integral_v<Scalar>) {
      constexpr double most = 2048;  // all integers up to this are exact as halves
      const double lower = whole_part_of_lower_end(volume);
      if (volume.range_hi - lower <= most) return true;
      for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
        const double stored = load_scalar<Scalar>(volume.voxels.data(), i) - lower;
        if (static_cast<double>(to_half(stored)) != stored) return false;
      }
      return true;
    }
    return false;
  });
}

VoxelGrid encode(Volume&& volume, VoxelFormat format) {
  if (volume.voxels.size() != volume.voxel_count() * bytes_of(volume.type)) {
    throw core::InputError(
        fmt::format("volume {} has {} bytes of voxel data; expected {}x{}x{} voxels of type {}",
                    volume.name, volume.voxels.size(), volume.size[0], volume.size[1],
                    volume.size[2], name_of(volume.type)));
  }
  VoxelGrid grid;
  grid.format = format;
  grid.size = volume.size;
  grid.spacing = volume.spacing;
  grid.range_lo = volume.range_lo;
  grid.range_hi = volume.range_hi;
  grid.mapping = volume.mapping;
  grid.name = volume.name;
  with_scalar_type(volume.type, [&](auto zero) { encode_from<decltype(zero)>(volume, grid); });
  volume.voxels = {};
  grid.hash = hash_of(grid);
  return grid;
}

}  // namespace triptych::scene
