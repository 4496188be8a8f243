#include "report/page/nearest_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace triptych::report {

std::vector<NearestBound> nearest_bounds(std::span<const judge::GateResult* const> results) {
  std::vector<NearestBound> bounds;
  for (const judge::GateResult* result : results) {
    std::map<std::string, NearestBound> by_device;
    for (const judge::Finding& finding : result->findings) {
      if (finding.check != judge::Check::image || finding.device.empty()) continue;
      if (finding.verdict != judge::Verdict::pass) continue;
      const auto ratio = finding.numbers.find("ratio");
      if (ratio == finding.numbers.end()) continue;
      NearestBound& bound = by_device[finding.device];
      ++bound.images;
      if (!bound.configuration.empty() && ratio->second <= bound.share) continue;
      bound.share = ratio->second;
      bound.configuration = finding.configuration;
    }
    for (auto& [device, bound] : by_device) {
      bound.plan = result->plan;
      bound.device = device;
      bounds.push_back(std::move(bound));
    }
  }
  return bounds;
}

std::string nearest_text(std::span<const NearestBound> bounds) {
  constexpr double weak_test_share = 0.01;
  if (bounds.empty()) return {};
  const auto [farthest, nearest] = std::ranges::minmax_element(bounds, {}, &NearestBound::share);
  std::string text = fmt::format("error / bound ≤ {:.3g}", nearest->share);
  if (farthest->share < weak_test_share && farthest != nearest) {
    text +=
        fmt::format(" (≤ {:.2g} on {} in {})", farthest->share, farthest->device, farthest->plan);
  }
  return text;
}

}  // namespace triptych::report
