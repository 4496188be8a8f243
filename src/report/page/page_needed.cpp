// Shows how much work remains after empty-space skipping and culling. Perfect skipping would leave
// only the samples that contribute to the image.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "report/html.hpp"
#include "report/page/page_frame.hpp"
#include "report/page/page_sections.hpp"

namespace triptych::report {
namespace {

struct Work {
  std::uint64_t taken = 0;
  std::uint64_t needed = 0;

  auto operator<=>(const Work&) const = default;
};

// Returns the work of a frame. For volumes: all samples, and the samples that are not transparent.
// For particles: the spheres that are drawn, and the spheres that are visible in at least one
// pixel.
std::optional<Work> work_of(const record::Counts& counters) {
  for (const auto& [taken, needed] :
       {std::pair{"samples", "samples_nonzero"}, std::pair{"particles_submitted", "visible_ids"}}) {
    const auto all = counters.find(taken);
    const auto shown = counters.find(needed);
    if (all == counters.end() || shown == counters.end() || all->second == 0) continue;
    return Work{all->second, shown->second};
  }
  return std::nullopt;
}

}  // namespace

Html needed_section(const PlanData& plan) {
  const bool volume = suite_of(plan) == "volume";
  const std::string factor = volume ? "skip" : "culling";
  // Devices that did the same work share a row.
  using Key = std::tuple<std::string, std::string, std::string, Work>;
  std::map<Key, std::set<std::string>> devices;
  for (const record::Record& record : plan.records) {
    const auto work = work_of(record.counters);
    const auto level = record.factors.find(factor);
    if (!work || level == record.factors.end()) continue;
    const std::string scene = image_title(plan, record);
    devices[{scene, record.technique, level->second, *work}].insert(record.device);
  }
  if (devices.empty()) return {};
  Rows rows{{"scene", "technique", factor, "taken", "needed", "needed / taken", "device"}};
  for (const auto& [key, names] : devices) {
    const auto& [scene, technique, level, work] = key;
    const double share = static_cast<double>(work.needed) / static_cast<double>(work.taken);
    rows.push_back({scene, technique, level, grouped(work.taken), grouped(work.needed),
                    fmt::format("{:.3f}", share), fmt::format("{}", fmt::join(names, ", "))});
  }
  return folded(
      "Skipping: total work, and the work that contributes to the image",
      markup(
          "<p>{}.</p>",
          volume
              ? "“Taken” is the total number of samples, and “needed” is the number of samples "
                "that are not transparent"
              : "“Taken” is the number of spheres that were drawn, and “needed” is the number of "
                "spheres that are visible in at least one pixel") +
          table(rows));
}

}  // namespace triptych::report
