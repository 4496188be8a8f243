// What skipping leaves: an oracle would take only what the picture shows.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "report/html.hpp"
#include "report/page_frame.hpp"
#include "report/page_sections.hpp"

namespace triptych::report {
namespace {

struct Work {
  std::uint64_t taken = 0;
  std::uint64_t needed = 0;

  auto operator<=>(const Work&) const = default;
};

// Samples, and those of them that are not transparent; spheres that are drawn, and those that a
// pixel shows.
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

std::string needed_section(const PlanData& plan) {
  // Devices that took the same stand together.
  std::map<std::tuple<std::string, std::string, Work>, std::string> devices;
  for (const record::Record& record : plan.records) {
    const auto work = work_of(record.counters);
    if (!work) continue;
    std::string& names = devices[{scene_title(plan, record), record.technique, *work}];
    names += (names.empty() ? "" : "<br>") + escape(record.device);
  }
  if (devices.empty()) return {};
  const bool volume = suite_of(plan) == "volume";
  std::vector<std::vector<std::string>> rows{
      {"scene", "technique", "taken", "needed", "needed of taken", "device"}};
  for (const auto& [key, names] : devices) {
    const auto& [scene, technique, work] = key;
    const double share = static_cast<double>(work.needed) / static_cast<double>(work.taken);
    rows.push_back({escape(scene), escape(technique), grouped(work.taken), grouped(work.needed),
                    fmt::format("{:.3f}", share), names});
  }
  return folded("Skipping: what was taken, and what the picture needed",
                volume ? "<p>Samples, and those that are not transparent.</p>" + table(rows)
                       : "<p>Spheres drawn, and those that a pixel shows.</p>" + table(rows));
}

}  // namespace triptych::report
