#include "measure/contract/equivalents.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

namespace triptych::measure {
namespace {

// An upper bound on the rounding error of a pixel's alpha. Alpha is computed in floats as 1 − T +
// T·background, where T is the transmittance of the ray and `background` is the alpha of the
// background. The three operations round numbers up to 1, so each of them has an error of at most
// 2⁻²⁴. The sum of these errors is less than 2⁻²².
constexpr double alpha_rounding = 0x1.0p-22;

std::string reason_for(const PlainWork& known, const PlainWork& requested, double transmittance) {
  std::vector<std::string> reasons;
  const auto add_reasons = [&](const PlainWork& from, const PlainWork& other) {
    for (const auto& [factor, why] : from.why) {
      if (!other.why.contains(factor)) reasons.push_back(factor + ": " + why);
    }
  };
  add_reasons(requested, known);
  add_reasons(known, requested);
  if (known.ends_below != requested.ends_below) {
    reasons.push_back(fmt::format("ert: no ray's transmittance falls below {:.3g}", transmittance));
  }
  return reasons.empty() ? "the differing levels have the same effect on this device"
                         : fmt::format("{}", fmt::join(reasons, "; "));
}

}  // namespace

double least_transmittance(const Work& work, const core::Image& image) {
  const auto* volume = std::get_if<VolumeWork>(&work.scene);
  if (volume == nullptr || image.rgba.empty()) return 0;
  const double background_weight = 1.0 - static_cast<double>(volume->scene.background[3]);
  if (!(background_weight > 0.5)) return 0;
  double alpha = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    const double pixel_alpha = static_cast<double>(image.rgba[i]);
    if (std::isnan(pixel_alpha)) return 0;
    alpha = std::max(alpha, pixel_alpha);
  }
  const double least = (1.0 - alpha - alpha_rounding) / background_weight;
  return least > 0 ? least : 0;
}

std::optional<Equivalent> Equivalents::find(const PlainWork& plain) const {
  const auto same = known_.find(plain.levels);
  if (same == known_.end()) return std::nullopt;
  for (const Known& known : same->second) {
    const bool distinguishable =
        known.plain.ends_below != plain.ends_below &&
        known.least_transmittance <= std::max(known.plain.ends_below, plain.ends_below);
    if (distinguishable) continue;
    return Equivalent{.key = known.key,
                      .reason = reason_for(known.plain, plain, known.least_transmittance)};
  }
  return std::nullopt;
}

void Equivalents::add(const PlainWork& plain, const std::string& key, const Work& work,
                      const core::Image& image) {
  known_[plain.levels].push_back({key, plain, least_transmittance(work, image)});
}

}  // namespace triptych::measure
