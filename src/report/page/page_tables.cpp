// The sections about devices, times, the speed of light (the time of the memory fetches alone) and
// counts, which consist mainly of tables.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "record/has_image.hpp"
#include "report/html.hpp"
#include "report/page/charts.hpp"
#include "report/page/page_frame.hpp"
#include "report/page/page_sections.hpp"
#include "report/words/outcome.hpp"

namespace triptych::report {
namespace {

// Shows how many statistics the driver counts exactly, and lists the other statistics.
Html calibration_text(const record::Device& device) {
  Html text;
  int exact = 0;
  for (const auto& [statistic, verdict] : device.statistics_calibration) {
    if (verdict.is_exact()) {
      ++exact;
    } else {
      text += markup("<div>{}: {}</div>", statistic, words::text_of(verdict));
    }
  }
  if (device.statistics_calibration.empty()) return markup("not calibrated");
  return markup("<div>statistics counted exactly: {}</div>", exact) + text;
}

Html clock_text(const std::vector<record::ClockTrust>& clocks) {
  Html text;
  for (const record::ClockTrust& clock : clocks) {
    text += markup("<div>{}: {}</div>", clock.work, clock.verdict);
  }
  return text;
}

// Returns the records that were timed and did not reuse the frames of another configuration.
std::vector<const record::Record*> timed_records(const PlanData& plan) {
  std::vector<const record::Record*> records;
  for (const record::Record& record : plan.records) {
    if (record.outcome == record::Outcome::measured && record.same_as.empty() &&
        !record.time_ns().empty()) {
      records.push_back(&record);
    }
  }
  return records;
}

// Returns a clock that timed both records, because times from different clocks are never compared.
std::string_view common_clock(const record::Record& a, const record::Record& b) {
  return a.clock() == b.clock() ? a.clock() : "wall";
}

// Returns a table of the records that reused the frames of another configuration, with the reasons.
Html reused_frames(const PlanData& plan) {
  Rows rows{{"configuration", "device", "same frames as", "reason"}};
  for (const record::Record& record : plan.records) {
    if (record.same_as.empty()) continue;
    rows.push_back(
        {record.configuration, record.device, record.same_as, words::text_of(record.reason)});
  }
  if (rows.size() == 1) return {};
  return folded(fmt::format("{} configurations reused the frames of an equivalent configuration",
                            rows.size() - 1),
                table(rows));
}

// Returns whether the technique only fetches memory, like speed_of_light, so that its time is a
// lower bound for the times of other techniques.
bool is_speed_of_light(const record::Record& record) {
  return !record::has_image(record) && record.code.empty();
}

}  // namespace

Html devices_section(const PlanData& plan) {
  Rows rows{{"device", "name", "driver", "API"}};
  Rows calibration_rows{{"device", "clock", "driver's statistics", "CPU features, environment"}};
  for (const auto& [device, clocks] : plan.devices) {
    Html environment = markup("{}", device.cpu_features);
    for (const auto& [name, value] : device.environment) {
      environment += markup("<div>{}={}</div>", name, value);
    }
    rows.push_back({device.id, device.name + " (" + device.vendor + ")", device.driver_version,
                    device.api_version});
    calibration_rows.push_back(
        {device.id, clock_text(clocks), calibration_text(device), environment});
  }
  return folded("Devices: drivers, calibration of clocks and statistics, environment variables",
                table(rows) + table(calibration_rows));
}

Html times_section(const PlanData& plan) {
  const auto records = timed_records(plan);
  if (records.empty()) return {};
  Rows rows{{"scene", "technique", "device", "clock", "minimum", "25 %", "median", "75 %", "90 %",
             "maximum", "back to back", "preparation"}};
  for (const record::Record* record : records) {
    const auto& samples = record->time_ns();
    const record::Summary summary = *record::summarise(samples);
    rows.push_back(
        {scene_title(plan, *record), record->technique, record->device,
         std::string(record->clock()), duration(summary.minimum), duration(summary.lower_quartile),
         duration(summary.median), duration(summary.upper_quartile),
         duration(record::percentile(samples, 0.9)), duration(summary.maximum),
         record->loop_frames > 0 ? duration(record->loop_wall_ns / record->loop_frames) : "",
         duration(record->prepare_ns)});
  }
  return folded(plan.verdict->times_decided ? "Times: judged" : "Times: shown, not judged",
                markup("<p>Each stroke is a timed frame, and the box spans the quartiles. “Back to "
                       "back” is the mean wall-clock time per frame in a loop that draws one frame "
                       "after the other and is timed as a whole.</p>") +
                    time_chart(plan) + folded("Table of times", table(rows, "times")) +
                    reused_frames(plan));
}

Html speed_of_light_section(const PlanData& plan) {
  // The records of speed_of_light, by device and scene.
  std::map<std::pair<std::string, std::string>, const record::Record*> bounds;
  for (const record::Record* record : timed_records(plan)) {
    if (is_speed_of_light(*record)) {
      bounds[{record->device, scene_title(plan, *record)}] = record;
    }
  }
  Rows rows{
      {"scene", "device", "technique", "clock", "time", "speed of light", "time / speed of light"}};
  for (const record::Record* record : timed_records(plan)) {
    const auto found = bounds.find({record->device, scene_title(plan, *record)});
    if (is_speed_of_light(*record) || found == bounds.end()) continue;
    const std::string_view clock = common_clock(*record, *found->second);
    const double time = record::percentile(record->time_ns_by(clock), 0.5);
    const double bound = record::percentile(found->second->time_ns_by(clock), 0.5);
    rows.push_back({scene_title(plan, *record), record->device, record->technique,
                    std::string(clock), duration(time), duration(bound),
                    fmt::format("{:.2f}", time / bound)});
  }
  if (rows.size() == 1) return {};
  return folded(
      "Speed of light: frame times relative to the time of the memory fetches alone",
      markup("<p>The speed of light is the time that the fetches and the transfer-function "
             "look-ups of a technique take without any other work. It is measured with the same "
             "empty-space skipping, but without early ray termination. A technique is hardly ever "
             "faster than "
             "the speed of light, unless its rays end early.</p>") +
          table(rows));
}

Html counts_section(const PlanData& plan) {
  Html text;
  const auto section = [&](std::string_view title, auto&& counts_of) {
    std::set<std::string> names;
    for (const record::Record& record : plan.records) {
      for (const auto& [name, value] : counts_of(record)) names.insert(name);
    }
    if (names.empty()) return;
    Rows rows{{"scene", "technique", "device"}};
    rows[0].insert(rows[0].end(), names.begin(), names.end());
    for (const record::Record& record : plan.records) {
      const record::Counts& counts = counts_of(record);
      if (counts.empty()) continue;
      rows.push_back({scene_title(plan, record), record.technique, record.device});
      for (const std::string& name : names) {
        const auto found = counts.find(name);
        rows.back().push_back(found == counts.end() ? "" : grouped(found->second));
      }
    }
    text += folded(title, table(rows, "counts"));
  };
  section(
      "Cost: instructions per frame, by the code that executes them; misses are 64-byte lines "
      "that device code loads into a simulated cache of 32 KiB",
      [](const record::Record& r) -> const record::Counts& { return r.cost; });
  section("Memory allocated on the device, bytes",
          [](const record::Record& r) -> const record::Counts& { return r.memory; });
  section("Energy per frame in microjoules, by meter; it includes all other work on the machine",
          [](const record::Record& r) -> const record::Counts& { return r.energy; });
  section("Triptych’s counters, from a variant of the device code that is never timed",
          [](const record::Record& r) -> const record::Counts& { return r.counters; });
  section(
      "Pipeline statistics as reported by the drivers; an empty cell means that the driver does "
      "not report the statistic",
      [](const record::Record& r) -> const record::Counts& { return r.statistics; });
  return text;
}

}  // namespace triptych::report
