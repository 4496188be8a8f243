// Instructions per frame against those stored for the same driver version, counted by the same
// emulator: device code, the driver and cache misses decide, each by itself; allocations and what
// preparing costs are shown.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "estimation/statistics.hpp"
#include "judge/baselines/frame_change.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

// What is worth a line, yet decides nothing: the configuration that it changed most in.
struct Note {
  std::size_t changed = 0;
  double worst = 0;
  std::string text;

  void add(const std::string& configuration, std::string_view name, double before, double now,
           double tolerated) {
    const double change = std::abs(now - before) / std::max(before, 1.0);
    if (change <= tolerated) return;
    ++changed;
    if (change <= worst) return;
    worst = change;
    text = configuration + ": " + change_text(name, before, now);
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
      add(findings, stored_ != nullptr ? Verdict::cannot_judge : Verdict::skipped,
          stored_ != nullptr ? "its instructions were not counted, though they were when it was "
                               "accepted: count them, or leave cost out of --check"
                             : "its instructions were not counted");
    } else if (const auto other = counted_otherwise(**counted)) {
      add(findings, Verdict::cannot_judge,
          fmt::format("its instructions were counted by {} and by {}: run the plan again",
                      (*counted)->counted_by, *other));
    } else if (stored_ == nullptr || stored_->counted_by != (*counted)->counted_by) {
      tell_other(**counted, findings);
    } else {
      for (const record::Record* record : records_) compare(*record, findings);
      tell_missing(findings);
      tell_notes(findings);
    }
  }

 private:
  void add(std::vector<Finding>& findings, Verdict verdict, std::string message) const {
    findings.push_back(finding_about(view_, device_, Check::cost, verdict, std::move(message)));
  }

  // By what else than that record: a resumed run, or one merged of shards.
  [[nodiscard]] std::optional<std::string> counted_otherwise(const record::Record& counted) const {
    for (const record::Record* record : records_) {
      if (record->cost.empty() || record->counted_by == counted.counted_by) continue;
      return record->counted_by;
    }
    return std::nullopt;
  }

  // Of another version of this driver, or by another emulator, the nearest that there is.
  void tell_other(const record::Record& counted, std::vector<Finding>& findings) const {
    const DriverCost* other = stored_;
    for (const auto& [driver, cost] : view_.baselines.cost_of_all_drivers()) {
      if (other == nullptr && cost.device == device_.id) other = &cost;
    }
    if (other == nullptr) {
      return add(findings, Verdict::advisory,
                 "no cost is stored of this device; store it with " + view_.accept_command());
    }
    std::vector<double> ratios;
    for (const record::Record* record : records_) {
      const auto there = other->configurations.find(record->configuration);
      if (record->cost.empty() || there == other->configurations.end()) continue;
      const double before = frame_of(there->second.frame);
      if (before > 0) ratios.push_back(frame_of(record->cost) / before);
    }
    std::string message = fmt::format(
        "nothing is judged: this is {} counted by {}, stored is {} counted by {}",
        device_.driver_version, counted.counted_by, other->driver_version, other->counted_by);
    if (!ratios.empty()) {
      message += fmt::format("; median of {} configurations {:+.3g} % instructions", ratios.size(),
                             100 * (estimation::median(ratios) - 1));
    }
    add(findings, Verdict::advisory, std::move(message));
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
    const FrameChange changes = frame_change(record, stored);
    const Verdict verdict = changes.more   ? Verdict::regression
                            : changes.less ? Verdict::improved
                                           : Verdict::pass;
    const double all = frame_of(record.cost);
    Finding finding =
        finding_about(record, Check::cost, verdict,
                      changes.texts.empty()
                          ? fmt::format("{:.0f} instructions, as stored", all)
                          : fmt::format("{} in all; {}", change_text("instructions", frame, all),
                                        fmt::join(changes.texts, "; ")));
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
                            std::string_view part, std::string_view name, double tolerated) {
      const auto a = count_of(before, part);
      const auto b = count_of(now, part);
      if (a && b) into.add(record.configuration, name, *a, *b, tolerated);
    };
    add_to(allocations_, stored.frame, record.cost, "allocations", "allocations", 0);
    add_to(preparing_, stored.prepare, record.prepare_cost, "driver", "driver", of_preparing);
  }

  void tell_missing(std::vector<Finding>& findings) const {
    if (!not_stored_.empty()) {
      add(findings, Verdict::cannot_judge,
          fmt::format("no stored cost for {}, though this driver was accepted; accept them: {}",
                      examples_of(not_stored_), view_.accept_command()));
    }
    if (!not_counted_.empty()) {
      add(findings, Verdict::cannot_judge,
          fmt::format("the instructions of {} were not counted; they were when they were accepted",
                      examples_of(not_counted_)));
    }
  }

  void tell_notes(std::vector<Finding>& findings) const {
    const auto tell = [&](const Note& each, std::string_view what) {
      if (each.changed == 0) return;
      add(findings, Verdict::advisory,
          fmt::format("{} changed in {} configurations, most in {}", what, each.changed,
                      each.text));
    };
    tell(allocations_, "allocations of a frame");
    tell(preparing_, "the driver's instructions while preparing");
  }

  const RunView& view_;
  const record::Device& device_;
  const DriverCost* stored_;  // of this driver version
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
