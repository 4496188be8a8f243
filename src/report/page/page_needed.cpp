// Shows the samples that remain after skipping. A perfect method would take only the samples that
// contribute to the image.

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

// For volumes, all samples and those that are not transparent. For particles, the spheres that are
// drawn and those that at least one pixel shows.
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
    const std::string scene = picture_title(plan, record);
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
      "Skipping: work that was done, and work that the image needed",
      markup("<p>{}.</p>",
             volume
                 ? "“Taken” counts all samples, and “needed” counts those that are not transparent"
                 : "“Taken” counts the spheres that were drawn, and “needed” counts those that a "
                   "pixel shows") +
          table(rows));
}

}  // namespace triptych::report
