// Compares the instruction counts of each frame with the counts that are stored for the same driver
// version and the same emulator (the program that counts instructions). The instructions of device
// code, the instructions of the driver, and the cache misses can each cause a regression.
// Allocations and the cost of preparation, which is everything before the first frame, are only
// shown. If instructions were counted but no comparable counts are stored, the cost cannot be
// judged.

#include <algorithm>
#include <cmath>
#include <optional>

#include "estimation/statistics.hpp"
#include "judge/baselines/frame_change.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

// A change that does not affect the verdict. It is reported for the configuration in which it is
// largest.
struct ChangeSummary {
  std::size_t changed = 0;
  double worst = 0;
  std::string configuration;
  Change largest;

  void add(const std::string& changed_configuration, Change change, double tolerance) {
    const double before = *change.before;
    const double share = std::abs(*change.now - before) / std::max(before, 1.0);
    if (share <= tolerance) return;
    ++changed;
    if (share <= worst) return;
    worst = share;
    configuration = changed_configuration;
    largest = std::move(change);
  }
};

class DeviceCostCheck {
 public:
  DeviceCostCheck(const RunView& view, const record::Device& device)
      : view_(view), device_(device), stored_(view.baselines.cost(device)) {}

  void add_record(const record::Record& record) { records_.push_back(&record); }

  void finish(std::vector<Finding>& findings) {
    const auto counted = std::ranges::find_if(
        records_, [](const record::Record* record) { return !record->cost.empty(); });
    if (counted == records_.end()) {
      const bool accepted = stored_ != nullptr;
      add(findings, accepted ? Verdict::cannot_judge : Verdict::skipped,
          {.cause = accepted ? Cause::no_longer_reported : Cause::not_reported},
          {accepted ? Advice::count : Advice::none});
    } else if (const auto other = other_emulator(**counted)) {
      add(findings, Verdict::cannot_judge,
          {.cause = Cause::two_counters,
           .facts = {{"counted_by", (*counted)->counted_by}, {"other", *other}}},
          {Advice::run_again});
    } else if (stored_ == nullptr || stored_->counted_by != (*counted)->counted_by) {
      report_other_driver(**counted, findings);
    } else {
      for (const record::Record* record : records_) compare(*record, findings);
      report_missing(findings);
      report_summaries(findings);
    }
  }

 private:
  void add(std::vector<Finding>& findings, Verdict verdict, Observation observation,
           AdviceWithCommand advice = {}) const {
    findings.push_back(finding_about(view_, device_, Check::cost, verdict, std::move(observation),
                                     std::move(advice)));
  }

  // Returns the name of another emulator if it counted the instructions of some of the records, or
  // nullopt if all records were counted by the same emulator as `counted`. The emulators can differ
  // in runs that were resumed, or merged from shards.
  [[nodiscard]] std::optional<std::string> other_emulator(const record::Record& counted) const {
    for (const record::Record* record : records_) {
      if (record->cost.empty() || record->counted_by == counted.counted_by) continue;
      return record->counted_by;
    }
    return std::nullopt;
  }

  // Compares with stored counts that are not directly comparable, because they come from another
  // version of this driver or from another emulator.
  void report_other_driver(const record::Record& counted, std::vector<Finding>& findings) const {
    const DriverCost* other = stored_;
    for (const auto& [driver, cost] : view_.baselines.cost_of_all_drivers()) {
      if (other == nullptr && cost.device == device_.id) other = &cost;
    }
    if (other == nullptr) {
      return add(findings, view_.not_stored_verdict(), {.cause = Cause::no_stored_device},
                 view_.accept_advice(Advice::accept_or_compare));
    }
    std::vector<double> ratios;
    double worst = 0;
    std::string worst_configuration;
    for (const record::Record* record : records_) {
      const auto other_cost = other->configurations.find(record->configuration);
      if (record->cost.empty() || other_cost == other->configurations.end()) continue;
      const double before = frame_instructions(other_cost->second.frame);
      if (before <= 0) continue;
      ratios.push_back(frame_instructions(record->cost) / before);
      if (ratios.back() <= worst) continue;
      worst = ratios.back();
      worst_configuration = record->configuration;
    }
    Observation observation{.cause = Cause::other_counter,
                            .against = Against::other_devices,
                            .facts = {{"driver_version", device_.driver_version},
                                      {"counted_by", counted.counted_by},
                                      {"other_version", other->driver_version},
                                      {"other", other->counted_by}}};
    if (!ratios.empty()) {
      observation.numbers["configurations"] = static_cast<double>(ratios.size());
      set_number(observation, "median_ratio", estimation::median(ratios));
      set_number(observation, "worst_ratio", worst);
      observation.facts["configuration"] = worst_configuration;
    }
    add(findings, view_.not_stored_verdict(), std::move(observation),
        view_.accept_advice(Advice::accept_or_compare));
  }

  void compare(const record::Record& record, std::vector<Finding>& findings) {
    const auto stored = stored_->configurations.find(record.configuration);
    if (stored == stored_->configurations.end()) {
      if (!record.cost.empty()) not_stored_.push_back(record.configuration);
    } else if (record.cost.empty()) {
      not_counted_.push_back(record.configuration);
    } else {
      findings.push_back(judge(record, stored->second.frame));
      summarise_changes(record, stored->second);
    }
  }

  static Finding judge(const record::Record& record, const record::Counts& stored) {
    const double frame = frame_instructions(stored);
    FrameChange change = frame_change(record, stored);
    const Verdict verdict = change.increased   ? Verdict::regression
                            : change.decreased ? Verdict::improved
                                               : Verdict::pass;
    const double instructions = frame_instructions(record.cost);
    Finding finding =
        finding_about(record, Check::cost, verdict,
                      {.cause = change.changes.empty() ? Cause::as_stored : Cause::values_changed,
                       .against = Against::baseline,
                       .numbers = {{"instructions", instructions}, {"stored_instructions", frame}},
                       .changes = std::move(change.changes)});
    if (frame > 0) set_number(finding, "ratio", instructions / frame);
    for (const auto& [name, count] : record.cost) {
      set_number(finding, name, static_cast<double>(count));
    }
    for (const auto& [name, count] : stored) {
      set_number(finding, "stored_" + name, static_cast<double>(count));
    }
    return finding;
  }

  void summarise_changes(const record::Record& record, const StoredCost& stored) {
    constexpr double prepare_tolerance = 0.05;
    const auto add_to = [&](ChangeSummary& summary, const record::Counts& before,
                            const record::Counts& now, const std::string& part, Unit unit,
                            double tolerance) {
      const auto a = count_of(before, part);
      const auto b = count_of(now, part);
      if (a && b) summary.add(record.configuration, {part, unit, *a, *b, {}, 0}, tolerance);
    };
    add_to(allocation_changes_, stored.frame, record.cost, "allocations", Unit::allocations, 0);
    // A driver that finds its compiled code in a cache executes far fewer instructions than one
    // that has to compile. A change by a factor of 2 or more therefore comes from the cache and is
    // not reported.
    constexpr double largest_uncached_ratio = 2;
    const auto before = count_of(stored.prepare, "driver");
    const auto now = count_of(record.prepare_cost, "driver");
    if (before && now && *now < largest_uncached_ratio * *before &&
        *before < largest_uncached_ratio * *now) {
      add_to(prepare_changes_, stored.prepare, record.prepare_cost, "driver", Unit::instructions,
             prepare_tolerance);
    }
  }

  void report_missing(std::vector<Finding>& findings) const {
    if (!not_stored_.empty()) {
      add(findings, Verdict::cannot_judge, {.cause = Cause::not_stored, .names = not_stored_},
          view_.accept_advice());
    }
    if (!not_counted_.empty()) {
      add(findings, Verdict::cannot_judge,
          {.cause = Cause::no_longer_reported, .names = not_counted_});
    }
  }

  void report_summaries(std::vector<Finding>& findings) const {
    const auto report = [&](const ChangeSummary& each, Cause cause) {
      if (each.changed == 0) return;
      add(findings, Verdict::advisory,
          {.cause = cause,
           .against = Against::baseline,
           .numbers = {{"configurations", static_cast<double>(each.changed)}},
           .changes = {each.largest},
           .facts = {{"configuration", each.configuration}}});
    };
    report(allocation_changes_, Cause::frame_allocations);
    report(prepare_changes_, Cause::preparing);
  }

  const RunView& view_;
  const record::Device& device_;
  const DriverCost* stored_;  // the stored cost of this driver version; may be nullptr
  std::vector<const record::Record*> records_;
  std::vector<std::string> not_stored_;
  std::vector<std::string> not_counted_;
  ChangeSummary allocation_changes_;
  ChangeSummary prepare_changes_;
};

}  // namespace

std::vector<Finding> check_cost(const RunView& view) {
  std::map<std::string, DeviceCostCheck> devices;
  for (const record::Record* record : view.measured) {
    devices.try_emplace(record->device, view, view.device(*record))
        .first->second.add_record(*record);
  }
  std::vector<Finding> findings;
  for (auto& [id, check] : devices) check.finish(findings);
  return findings;
}

}  // namespace triptych::judge
