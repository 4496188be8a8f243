// Shows the statistics that GPU compilers report, by configuration and device, and the old and new
// disassembly of code that got worse.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "judge/code/code_change.hpp"
#include "report/html.hpp"
#include "report/page/line_diff.hpp"
#include "report/page/page_frame.hpp"
#include "report/page/page_sections.hpp"

namespace triptych::report {
namespace {

using record::Check;

// Returns the sum of a statistic over the executables of a configuration. For occupancy, returns
// the smallest value instead, because the executable with the fewest waves hides the least latency.
std::optional<double> combined_statistic(const record::Code& code, std::string_view name) {
  std::optional<double> all;
  for (const auto& [executable, what] : code) {
    for (const auto& [driver_name, value] : what.statistics) {
      const judge::CodeStatistic statistic = judge::code_statistic(driver_name);
      if (statistic.name != name) continue;
      all = !all ? value : statistic.more_is_worse ? *all + value : std::min(*all, value);
    }
  }
  return all;
}

Html cell_of(const record::Code& code) {
  Html cell;
  const auto add = [&](std::string_view name, std::string_view unit) {
    const auto value = combined_statistic(code, name);
    if (value) cell += markup("<div>{:g} {}</div>", *value, unit);
  };
  add("instructions", "instructions");
  add("instructions per iteration", "instructions per iteration");
  add("occupancy", "waves");
  add("inverse throughput", "cycles per wave");
  add("registers", "registers");
  add("spilled VGPRs", "spilled VGPRs");
  return cell.empty() ? markup("the compiler reports none of these statistics") : cell;
}

Html statistics_table(const PlanData& plan) {
  std::map<std::string, std::map<std::string, Html>> cells;  // by configuration and device
  std::set<std::string> devices;
  for (const record::Record& record : plan.records) {
    if (record.code.empty()) continue;
    devices.insert(record.device);
    cells[record.configuration][record.device] = cell_of(record.code);
  }
  if (cells.empty()) return {};
  Rows rows{{"configuration"}};
  for (const std::string& device : devices) rows.front().emplace_back(device);
  for (const auto& [configuration, by_device] : cells) {
    TableRow row{breakable(configuration)};
    for (const std::string& device : devices) {
      const auto found = by_device.find(device);
      row.emplace_back(found == by_device.end() ? markup("not compiled") : found->second);
    }
    rows.push_back(std::move(row));
  }
  return table(rows);
}

const record::Record* record_of(const std::vector<record::Record>& records,
                                const judge::Finding& finding) {
  const auto found = std::ranges::find_if(records, [&](const record::Record& record) {
    return record.device == finding.device && record.configuration == finding.configuration;
  });
  return found == records.end() ? nullptr : &*found;
}

// Finds disassemblies in earlier runs, because the baselines contain only their hashes.
class EarlierRuns {
 public:
  EarlierRuns(const record::Store& store, const PlanData& plan) : store_(store) {
    for (const record::Run& run : store.runs()) {
      if (run.plan == plan.name && run.id != plan.verdict->run) runs_.push_back(run.id);
    }
  }

  // Returns the latest disassembly of this executable that differs from `now`, or nullopt if the
  // store contains none.
  std::optional<std::string> assembly(const judge::Finding& finding, const std::string& executable,
                                      const std::string& now) {
    for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
      const record::Record* record = record_of(records_of(*run), finding);
      if (record == nullptr || !record->injected.empty()) continue;
      const auto found = record->code.find(executable);
      if (found == record->code.end() || found->second.assembly == now) continue;
      if (auto text = store_.listing(found->second.assembly)) return text;
    }
    return std::nullopt;
  }

 private:
  const std::vector<record::Record>& records_of(const std::string& run) {
    const auto [known, fresh] = records_.try_emplace(run);
    if (fresh) known->second = store_.records(run);
    return known->second;
  }

  const record::Store& store_;
  std::vector<std::string> runs_;
  std::map<std::string, std::vector<record::Record>> records_;
};

Html side_by_side(const std::string& before, const std::string& now) {
  Rows rows{{"before", "now"}};
  for (const LinePair& pair : line_diff(before, now)) {
    const auto cell = [&](const std::string& text) {
      const bool marked = pair.changed && !text.empty();
      return marked ? markup("<mark><code>{}</code></mark>", text)
                    : markup("<code>{}</code>", text);
    };
    rows.push_back({cell(pair.before), cell(pair.now)});
  }
  return table(rows);
}

// Returns the old and the new disassembly of each executable of the configuration, or nothing if
// the store has no earlier disassembly.
Html disassembly_of(const record::Store& store, const judge::Finding& finding,
                    const record::Record& record, EarlierRuns& earlier) {
  Html html;
  for (const auto& [name, executable] : record.code) {
    if (executable.assembly.empty()) continue;
    const auto now = store.listing(executable.assembly);
    const auto before = earlier.assembly(finding, name, executable.assembly);
    if (!now || !before) continue;
    html += markup("<h4>{}</h4>{}", name, side_by_side(*before, *now));
  }
  return html;
}

Html changed_disassembly(const record::Store& store, const PlanData& plan) {
  Html html;
  int without_earlier = 0;
  EarlierRuns earlier(store, plan);
  for (const judge::Finding& finding : plan.verdict->findings) {
    if (finding.check != Check::code || finding.verdict != judge::Verdict::regression) continue;
    const record::Record* record = record_of(plan.records, finding);
    if (record == nullptr || record->code.empty()) continue;
    const Html both = disassembly_of(store, finding, *record, earlier);
    if (both.empty()) {
      ++without_earlier;
    } else {
      html += folded(markup("{}, {}", finding.device, breakable(finding.configuration)), both);
    }
  }
  if (without_earlier > 0) {
    html += markup(
        "<p>The store contains no earlier disassembly for {} of the findings. To see the old and "
        "the new disassembly, compare with the previous build (<code>triptych gate --base "
        "PROGRAM</code>), or first run the plan with the previous build and the same store.</p>",
        without_earlier);
  }
  return html.empty() ? html : markup("<h3>Disassembly of code that got worse</h3>") + html;
}

}  // namespace

Html code_section(const record::Store& store, const PlanData& plan) {
  const Html statistics = statistics_table(plan);
  if (statistics.empty()) return {};
  return changed_disassembly(store, plan) +
         folded(markup("Code statistics by technique and device"), statistics);
}

}  // namespace triptych::report
