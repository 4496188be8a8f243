// Compares the instruction counts of each frame with the counts that are stored for the same driver
// version and the same emulator (the program that counts instructions). The instructions of device
// code, the instructions of the driver, and the cache misses can each cause a regression.
// Allocations and the cost of preparation, which is everything before the first frame, are only
// shown.

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
struct Note {
  std::size_t changed = 0;
  double worst = 0;
  std::string configuration;
  Change largest;

  void add(const std::string& in, Change change, double tolerated) {
    const double before = *change.before;
    const double share = std::abs(*change.now - before) / std::max(before, 1.0);
    if (share <= tolerated) return;
    ++changed;
    if (share <= worst) return;
    worst = share;
    configuration = in;
    largest = std::move(change);
  }
};

class DeviceCostCheck {
 public:
  DeviceCostCheck(const RunView& view, const record::Device& device)
      : view_(view), device_(device), stored_(view.baselines.cost(device)) {}

  void look_at(const record::Record& record) { records_.push_back(&record); }

  void finish(std::vector<Finding>& findings) {
    const auto counted = std::ranges::find_if(
        records_, [](const record::Record* record) { return !record->cost.empty(); });
    if (counted == records_.end()) {
      const bool accepted = stored_ != nullptr;
      add(findings, accepted ? Verdict::cannot_judge : Verdict::skipped,
          {.cause = accepted ? Cause::no_longer_reported : Cause::not_reported},
          {accepted ? Advice::count : Advice::none});
    } else if (const auto other = counted_otherwise(**counted)) {
      add(findings, Verdict::cannot_judge,
          {.cause = Cause::two_counters,
           .facts = {{"counted_by", (*counted)->counted_by}, {"other", *other}}},
          {Advice::run_again});
    } else if (stored_ == nullptr || stored_->counted_by != (*counted)->counted_by) {
      tell_other(**counted, findings);
    } else {
      for (const record::Record* record : records_) compare(*record, findings);
      tell_missing(findings);
      tell_notes(findings);
    }
  }

 private:
  void add(std::vector<Finding>& findings, Verdict verdict, Observation what,
           Advised advice = {}) const {
    findings.push_back(
        finding_about(view_, device_, Check::cost, verdict, std::move(what), std::move(advice)));
  }

  // Returns the name of another emulator if it counted the instructions of some of the records, or
  // nullopt if all records were counted by the same emulator as `counted`. The emulators can differ
  // in runs that were resumed, or merged from shards.
  [[nodiscard]] std::optional<std::string> counted_otherwise(const record::Record& counted) const {
    for (const record::Record* record : records_) {
      if (record->cost.empty() || record->counted_by == counted.counted_by) continue;
      return record->counted_by;
    }
    return std::nullopt;
  }

  // Compares with stored counts that are not directly comparable, because they come from another
  // version of this driver or from another emulator.
  void tell_other(const record::Record& counted, std::vector<Finding>& findings) const {
    const DriverCost* other = stored_;
    for (const auto& [driver, cost] : view_.baselines.cost_of_all_drivers()) {
      if (other == nullptr && cost.device == device_.id) other = &cost;
    }
    if (other == nullptr) {
      return add(findings, Verdict::advisory, {.cause = Cause::no_stored_device}, view_.accept());
    }
    std::vector<double> ratios;
    for (const record::Record* record : records_) {
      const auto there = other->configurations.find(record->configuration);
      if (record->cost.empty() || there == other->configurations.end()) continue;
      const double before = frame_of(there->second.frame);
      if (before > 0) ratios.push_back(frame_of(record->cost) / before);
    }
    Observation what{.cause = Cause::other_counter,
                     .against = Against::other_devices,
                     .facts = {{"driver_version", device_.driver_version},
                               {"counted_by", counted.counted_by},
                               {"other_version", other->driver_version},
                               {"other", other->counted_by}}};
    if (!ratios.empty()) {
      what.numbers["configurations"] = static_cast<double>(ratios.size());
      set_number(what, "median_ratio", estimation::median(ratios));
    }
    add(findings, Verdict::advisory, std::move(what));
  }

  void compare(const record::Record& record, std::vector<Finding>& findings) {
    const auto stored = stored_->configurations.find(record.configuration);
    if (stored == stored_->configurations.end()) {
      if (!record.cost.empty()) not_stored_.push_back(record.configuration);
    } else if (record.cost.empty()) {
      not_counted_.push_back(record.configuration);
    } else {
      findings.push_back(judge(record, stored->second.frame));
      note(record, stored->second);
    }
  }

  static Finding judge(const record::Record& record, const record::Counts& stored) {
    const double frame = frame_of(stored);
    FrameChange found = frame_change(record, stored);
    const Verdict verdict = found.more   ? Verdict::regression
                            : found.less ? Verdict::improved
                                         : Verdict::pass;
    const double all = frame_of(record.cost);
    Finding finding =
        finding_about(record, Check::cost, verdict,
                      {.cause = found.changes.empty() ? Cause::as_stored : Cause::values_changed,
                       .against = Against::baseline,
                       .numbers = {{"instructions", all}, {"stored_instructions", frame}},
                       .changes = std::move(found.changes)});
    if (frame > 0) set_number(finding, "ratio", all / frame);
    for (const auto& [name, count] : record.cost) {
      set_number(finding, name, static_cast<double>(count));
    }
    for (const auto& [name, count] : stored) {
      set_number(finding, "stored_" + name, static_cast<double>(count));
    }
    return finding;
  }

  void note(const record::Record& record, const StoredCost& stored) {
    constexpr double of_preparing = 0.05;
    const auto add_to = [&](Note& into, const record::Counts& before, const record::Counts& now,
                            const std::string& part, Unit unit, double tolerated) {
      const auto a = count_of(before, part);
      const auto b = count_of(now, part);
      if (a && b) into.add(record.configuration, {part, unit, *a, *b, {}, 0}, tolerated);
    };
    add_to(allocations_, stored.frame, record.cost, "allocations", Unit::allocations, 0);
    // A driver that finds its compiled code in a cache executes far fewer instructions than one
    // that has to compile. A change by a factor of 2 or more therefore comes from the cache and is
    // not reported.
    constexpr double most_without_a_cache = 2;
    const auto before = count_of(stored.prepare, "driver");
    const auto now = count_of(record.prepare_cost, "driver");
    if (before && now && *now < most_without_a_cache * *before &&
        *before < most_without_a_cache * *now) {
      add_to(preparing_, stored.prepare, record.prepare_cost, "driver", Unit::instructions,
             of_preparing);
    }
  }

  void tell_missing(std::vector<Finding>& findings) const {
    if (!not_stored_.empty()) {
      add(findings, Verdict::cannot_judge, {.cause = Cause::not_stored, .names = not_stored_},
          view_.accept());
    }
    if (!not_counted_.empty()) {
      add(findings, Verdict::cannot_judge,
          {.cause = Cause::no_longer_reported, .names = not_counted_});
    }
  }

  void tell_notes(std::vector<Finding>& findings) const {
    const auto tell = [&](const Note& each, Cause cause) {
      if (each.changed == 0) return;
      add(findings, Verdict::advisory,
          {.cause = cause,
           .against = Against::baseline,
           .numbers = {{"configurations", static_cast<double>(each.changed)}},
           .changes = {each.largest},
           .facts = {{"configuration", each.configuration}}});
    };
    tell(allocations_, Cause::frame_allocations);
    tell(preparing_, Cause::preparing);
  }

  const RunView& view_;
  const record::Device& device_;
  const DriverCost* stored_;  // the stored cost of this driver version; may be nullptr
  std::vector<const record::Record*> records_;
  std::vector<std::string> not_stored_;
  std::vector<std::string> not_counted_;
  Note allocations_;
  Note preparing_;
};

}  // namespace

std::vector<Finding> check_cost(const RunView& view) {
  std::map<std::string, DeviceCostCheck> devices;
  for (const record::Record* record : view.measured) {
    devices.try_emplace(record->device, view, view.device(*record)).first->second.look_at(*record);
  }
  std::vector<Finding> findings;
  for (auto& [id, check] : devices) check.finish(findings);
  return findings;
}

}  // namespace triptych::judge
