#include "technique/volume/brick_kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "scene/exact_math.hpp"
#include "technique/catalogue.hpp"

namespace triptych::technique {
namespace {

constexpr std::size_t function_entries =
    std::tuple_size_v<decltype(scene::TransferFunction::entries)>;

// The smallest and largest value of each of the four channels.
struct Extremes {
  std::array<double, 4> least;
  std::array<double, 4> largest;

  void widen(const Extremes& other) {
    for (std::size_t c = 0; c < 4; ++c) {
      least[c] = std::min(least[c], other.least[c]);
      largest[c] = std::max(largest[c], other.largest[c]);
    }
  }
};

// Finds the extremes of a transfer function over a range of values. The function is linear between
// its entries.
class FunctionExtremes {
 public:
  explicit FunctionExtremes(const scene::TransferFunction& function) {
    std::ranges::transform(function.entries, levels_[0].begin(), [](const auto& entry) {
      const std::array<double, 4> channels{entry[0], entry[1], entry[2], entry[3]};
      return Extremes{channels, channels};
    });
    for (std::size_t level = 1; level < levels_.size(); ++level) {
      const std::size_t half = std::size_t{1} << (level - 1);
      for (std::size_t k = 0; k + 2 * half <= function_entries; ++k) {
        levels_[level][k] = levels_[level - 1][k];
        levels_[level][k].widen(levels_[level - 1][k + half]);
      }
    }
  }

  [[nodiscard]] Extremes over(double lo, double hi) const {
    const double from = position(lo);
    const double to = position(hi);
    Extremes extremes = at(from);
    extremes.widen(at(to));
    const auto first = static_cast<std::size_t>(std::ceil(from));
    const auto last = static_cast<std::size_t>(to);
    if (first > last) return extremes;
    const auto level = static_cast<std::size_t>(std::bit_width(last - first + 1) - 1);
    extremes.widen(levels_[level][first]);
    extremes.widen(levels_[level][last + 1 - (std::size_t{1} << level)]);
    return extremes;
  }

  [[nodiscard]] const Extremes& overall() const { return levels_.back()[0]; }

 private:
  // Level n contains, for each entry, the extremes over the 2ⁿ entries that start at this entry.
  std::array<std::array<Extremes, function_entries>, std::bit_width(function_entries)> levels_{};

  [[nodiscard]] static double position(double value) {
    return std::clamp(value * function_entries - 0.5, 0.0,
                      static_cast<double>(function_entries - 1));
  }

  [[nodiscard]] Extremes at(double position) const {
    const auto below = std::min(static_cast<std::size_t>(position), function_entries - 2);
    const double weight = position - static_cast<double>(below);
    Extremes between = levels_[0][below];
    for (std::size_t c = 0; c < 4; ++c) {
      between.least[c] += weight * (levels_[0][below + 1].least[c] - between.least[c]);
    }
    between.largest = between.least;
    return between;
  }
};

// Returns x^exponent for an exponent that is a power of two. It uses only multiplication, because
// the result of std::pow depends on the C library.
double power(double x, int exponent) {
  for (; exponent > 1; exponent /= 2) x *= x;
  return x;
}

// Decides for one brick at a time whether its samples may be merged.
class Merging {
 public:
  Merging(const scene::VolumeScene& scene, double adapt)
      : function_(scene.transfer_function),
        light_(scene.shading),
        offset_(scene.grid->offset),
        opaque_share_(adapt / 2) {
    const double voxel = scene.smallest_spacing();
    const scene::Box box = scene.box();
    thin_share_ = adapt / 2 * voxel / glm::length(box.hi - box.lo);
    const glm::dvec3 scale(voxel / scene.grid->spacing[0], voxel / scene.grid->spacing[1],
                           voxel / scene.grid->spacing[2]);
    steepest_ = 0.5 * glm::length(scale) / light_.gradient_floor;
    colour_range_ = 1;  // opacities range from 0 to 1
    for (std::size_t c = 0; c < 3; ++c) {
      const double most = lit(function_.overall().largest[c], 1.0);
      const auto behind = static_cast<double>(scene.background[c]);
      colour_range_ = std::max({colour_range_, most, behind});
    }
  }

  [[nodiscard]] bool operator()(double lo, double hi) const {
    constexpr double unit_roundoff = 0x1.0p-24;
    const double magnitude = std::max(std::abs(lo - offset_), std::abs(hi - offset_));
    const double rounding = lo == hi ? 0 : 16 * unit_roundoff * (magnitude + std::abs(offset_));
    const Extremes range = function_.over(lo - rounding, hi + rounding);
    if (!(range.largest[3] < 1)) return false;  // an opaque sample would end a ray
    const double a = -scene::logarithm_of_1_plus(-range.least[3]);
    const double b = -scene::logarithm_of_1_plus(-range.largest[3]);
    // No central difference exceeds half the brick's range of values.
    const double steepness = lo == hi ? 0 : std::min(1.0, steepest_ * (hi - lo + 2 * rounding));
    double colours = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      colours = std::max(colours, lit(range.largest[c], steepness) - lit(range.least[c], 0.0));
    }
    const double spent = std::min(colours, opaque_share_);
    return colour_range_ * (b - a) + (colours - spent) * b <=
           (opaque_share_ - spent) * a + thin_share_;
  }

 private:
  FunctionExtremes function_;
  scene::Shading light_;
  double offset_;
  double opaque_share_;      // K in the derivation (brick_kinds.hpp)
  double thin_share_ = 0;    // Y in the derivation (brick_kinds.hpp)
  double colour_range_ = 1;  // R in the derivation (brick_kinds.hpp)
  // The cosine in the shading is at most this number times the width of a brick's range of values.
  double steepest_ = 0;

  // Returns a colour after shading with this cosine. A larger cosine gives a brighter colour.
  [[nodiscard]] double lit(double colour, double cosine) const {
    if (!light_.enabled) return colour;
    return colour * (light_.ambient + light_.diffuse * cosine) +
           light_.specular * power(cosine, light_.exponent);
  }
};

}  // namespace

std::vector<std::int32_t> brick_kinds(const BrickRanges& ranges, const scene::VolumeScene& scene,
                                      double adapt) {
  const auto visible = brick_visibility(ranges, scene.transfer_function);
  const Merging may_merge(scene, adapt);
  std::vector<std::int32_t> kinds(visible.size());
  // The BrickKind number of each value that fills a homogeneous brick.
  std::unordered_map<float, std::int32_t> numbers;
  for (std::size_t b = 0; b < kinds.size(); ++b) {
    const float lo = ranges.minimum[b];
    const float hi = ranges.maximum[b];
    BrickKind kind = BrickKind::invisible;
    if (visible[b] != 0) {
      const bool merges = may_merge(static_cast<double>(lo), static_cast<double>(hi));
      kind = merges ? BrickKind::merged : BrickKind::sampled;
    }
    kinds[b] = static_cast<std::int32_t>(kind);
    if (kind == BrickKind::merged && lo == hi) {
      const auto next = static_cast<std::int32_t>(BrickKind::homogeneous) +
                        static_cast<std::int32_t>(numbers.size());
      kinds[b] = numbers.try_emplace(lo, next).first->second;
    }
  }
  return kinds;
}

std::optional<std::string> adapt_reason(std::string_view technique, const scene::VolumeScene& scene,
                                        const RaycastOptions& options) {
  if (!(options.adapt > 0)) return std::nullopt;
  if (!technique::technique(technique).draws_image) {
    return fmt::format(
        "the technique {} does not support the factor adapt, because this technique never merges "
        "samples",
        technique);
  }
  if (scene.quadrature != scene::Quadrature::midpoint) {
    return "the factor adapt requires quadrature=midpoint, the only quadrature that takes one "
           "sample in the middle of each step";
  }
  if (options.skip == Skip::none) {
    return "the factor adapt requires skip=bricks, because samples are merged within bricks, and "
           "skip=none uses no bricks";
  }
  if (options.skip == Skip::distance) {
    return "the factor adapt requires skip=bricks, because skip=distance leaps across several "
           "bricks with different values";
  }
  return std::nullopt;
}

}  // namespace triptych::technique
