// Shows values, costs and times that differ from the stored values.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "record/short_name.hpp"
#include "report/html.hpp"
#include "report/page/page_frame.hpp"
#include "report/page/page_sections.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using judge::Finding;

struct Change {
  const Finding* finding;
  const record::Record* record;
  double share;  // relative change: 0.01 is 1 % more than the stored value
};

std::vector<Change> changes_in(const PlanData& plan, Check check) {
  using Place = std::pair<std::string_view, std::string_view>;  // device, configuration
  std::map<Place, const record::Record*> records;
  for (const record::Record& each : plan.records) {
    records.emplace(Place(each.device, each.configuration), &each);
  }
  std::vector<Change> all;
  for (const Finding& finding : plan.verdict->findings) {
    const auto ratio = finding.numbers.find("ratio");
    const auto record = records.find({finding.device, finding.configuration});
    if (finding.check != check || record == records.end()) continue;
    if (ratio != finding.numbers.end()) {
      all.push_back({&finding, record->second, ratio->second - 1});
    }
  }
  return all;
}

std::string percent(double share) {
  return fmt::format("{:+.2f} %", 100 * share);
}

// Returns a bar whose length is the change relative to the largest change. Increases and decreases
// have different colours.
Html bar(double share, double largest) {
  return markup("<span class=\"bar {}\" style=\"width:{:.1f}%\"></span>",
                share > 0 ? "more" : "less", largest > 0 ? 100 * std::abs(share) / largest : 0);
}

// Returns "1 000 → 1 010", or "" if this part was not counted.
std::string counts_of(const Finding& finding, const std::string& part) {
  const auto now = finding.numbers.find(part);
  const auto stored = finding.numbers.find("stored_" + part);
  if (now == finding.numbers.end() || stored == finding.numbers.end()) return {};
  return fmt::format("{} → {}", grouped(static_cast<std::uint64_t>(stored->second)),
                     grouped(static_cast<std::uint64_t>(now->second)));
}

// Returns a table of the configurations whose cost differs from the stored cost, the largest change
// first.
Html cost_bars(const PlanData& plan) {
  const std::vector<Change> all = changes_in(plan, Check::cost);
  if (all.empty()) return {};
  std::vector<Change> changed;
  std::ranges::copy_if(all, std::back_inserter(changed), [](const Change& each) {
    return each.finding->verdict != judge::Verdict::pass;
  });
  if (changed.empty()) {
    return markup("<p>All {} frames execute the stored number of instructions.</p>\n", all.size());
  }
  std::ranges::stable_sort(changed, std::greater{},
                           [](const Change& each) { return std::abs(each.share); });
  constexpr std::size_t shown = 12;
  const Html summary = markup(
      "<p>{} of {} frames do not execute the stored number of instructions{}.</p>\n",
      changed.size(), all.size(),
      changed.size() > shown ? fmt::format("; the table shows the {} largest changes", shown) : "");
  changed.resize(std::min(shown, changed.size()));
  Rows rows{{"device", "technique", "scene", "device code", "driver", "total", ""}};
  for (const Change& each : changed) {
    rows.push_back({each.finding->device, each.record->technique,
                    breakable(scene_title(plan, *each.record)),
                    counts_of(*each.finding, "device_code"), counts_of(*each.finding, "driver"),
                    percent(each.share), bar(each.share, std::abs(changed.front().share))});
  }
  return summary + table(rows, "bars");
}

std::string value_text(const std::optional<double>& value) {
  if (!value) return "–";
  const bool whole = *value >= 0 && *value == std::floor(*value) && *value < 9e15;
  return whole ? grouped(static_cast<std::uint64_t>(*value)) : fmt::format("{:.6g}", *value);
}

std::string change_text(const judge::Change& change) {
  if (!change.before) return "new";
  if (!change.now) return "missing";
  if (*change.before == 0) return "";
  return percent(*change.now / *change.before - 1);
}

// A changed value, and the finding that contains it.
struct ChangedValue {
  const Finding* finding;
  const judge::Change* change;
  [[nodiscard]] double size() const {
    const bool both = change->before && change->now && *change->before > 0 && *change->now > 0;
    return both ? std::abs(std::log(*change->now / *change->before))
                : std::numeric_limits<double>::infinity();
  }
};

Html values_table(std::span<const ChangedValue> values) {
  Rows rows{{"device", "configuration", "value", "stored", "now", "change"}};
  for (const auto& [finding, change] : values) {
    const std::string name = record::short_name(finding->configuration);
    rows.push_back({finding->device, breakable(name.empty() ? finding->configuration : name),
                    change->name, value_text(change->before), value_text(change->now),
                    change_text(*change)});
  }
  return table(rows, "values");
}

// Returns tables of the values that differ from the stored values, one for each check, the largest
// change first. Cost and times are left out, because they are shown as bars.
Html changed_values(const PlanData& plan) {
  std::map<Check, std::vector<ChangedValue>> by_check;
  for (const Finding& finding : plan.verdict->findings) {
    if (finding.check == Check::cost || finding.check == Check::timing) continue;
    for (const judge::Change& change : finding.changes) {
      by_check[finding.check].push_back({&finding, &change});
    }
  }
  Html text;
  for (auto& [check, values] : by_check) {
    std::ranges::stable_sort(values, std::greater{}, &ChangedValue::size);
    constexpr std::size_t shown = 12;
    constexpr std::size_t listed = 200;
    const std::span<const ChangedValue> all(values);
    const std::span<const ChangedValue> rest =
        all.subspan(std::min(shown, all.size()))
            .first(std::min(listed, all.size() - std::min(shown, all.size())));
    text += markup(
                "<div data-kind=\"values\" data-check=\"{}\"><h4>{}: {} of the stored values "
                "differ</h4>",
                judge::name_of(check), judge::name_of(check), all.size()) +
            values_table(all.first(std::min(shown, all.size())));
    if (!rest.empty()) {
      text += folded(fmt::format("{} more", all.size() - shown), values_table(rest));
    }
    text += markup("</div>\n");
  }
  return text;
}

// Returns a table with the median and the quartiles of the changes in time, for each technique on
// each device.
Html time_bars(const PlanData& plan) {
  std::map<std::pair<std::string, std::string>, std::vector<double>> by_row;
  for (const Change& each : changes_in(plan, Check::timing)) {
    by_row[{each.finding->device, each.record->technique}].push_back(each.share);
  }
  double largest = 0;
  for (const auto& [row, shares] : by_row) {
    largest = std::max(largest, std::abs(record::percentile(shares, 0.5)));
  }
  Rows rows{{"device", "technique", "median", "", "25 %", "75 %", "configurations"}};
  for (const auto& [row, shares] : by_row) {
    const record::Summary of = *record::summarise(shares);
    rows.push_back({row.first, row.second, percent(of.median), bar(of.median, largest),
                    percent(of.lower_quartile), percent(of.upper_quartile),
                    fmt::to_string(shares.size())});
  }
  if (by_row.empty()) return {};
  return markup(
             "<p>Times relative to the stored times: median and quartiles over the "
             "configurations.</p>\n") +
         table(rows, "bars");
}

}  // namespace

Html changes_section(const PlanData& plan) {
  const Html all = changed_values(plan) + cost_bars(plan) + time_bars(plan);
  return all.empty() ? all : markup("<h3>Differences from the stored values</h3>\n") + all;
}

}  // namespace triptych::report
