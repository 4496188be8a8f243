// Compares the statistics that GPU compilers report with the stored statistics of the same driver
// version. The values must be equal on any machine, because the output of these compilers does not
// depend on the machine on which they run.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "judge/code/code_change.hpp"
#include "judge/code/code_totals.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

// Converts a CodeChange to a Change. The name of the result is the name of the statistic, preceded
// by the name of the executable if several executables changed.
Change change_of(const CodeChange& change, bool several_executables) {
  const std::string_view name =
      change.statistic.name.empty() ? std::string_view(change.driver_name) : change.statistic.name;
  return {.name = several_executables ? fmt::format("{} {}", change.executable, name)
                                      : std::string(name),
          .before = change.before,
          .now = change.now};
}

std::vector<Change> changes_of(const CodeComparison& comparison) {
  const bool several_executables =
      std::ranges::any_of(comparison.changes, [&](const CodeChange& each) {
        return each.executable != comparison.changes.front().executable;
      });
  std::vector<Change> changes;
  for (const CodeChange& each : comparison.changes)
    changes.push_back(change_of(each, several_executables));
  return changes;
}

std::vector<Change> changes_of(const CodeTotals& totals) {
  std::vector<Change> changes;
  for (const auto& [name, total] : totals.totals()) {
    if (total.helped + total.hurt == 0) continue;
    changes.push_back({.name = name, .before = total.before, .now = total.now});
  }
  return changes;
}

// Returns whether executables were added or removed, so that the configuration cannot be compared
// executable by executable.
bool has_other_executables(const CodeComparison& comparison) {
  return !comparison.removed.empty() || !comparison.added.empty();
}

Verdict verdict_of(const CodeComparison& comparison) {
  const CodeDirection direction = comparison.direction();
  if (direction == CodeDirection::worse) return Verdict::regression;
  if (has_other_executables(comparison)) return Verdict::cannot_judge;
  if (direction == CodeDirection::better) return Verdict::improved;
  return direction == CodeDirection::other ? Verdict::advisory : Verdict::pass;
}

// Returns the largest relative change of a statistic that affects the verdict. Findings are sorted
// by this ratio.
double ratio_of(const CodeComparison& comparison) {
  double ratio = 1;
  for (const CodeChange& each : comparison.changes) {
    if (!each.statistic.decides || each.before <= 0 || each.now <= 0) continue;
    ratio =
        std::max(ratio, each.now > each.before ? each.now / each.before : each.before / each.now);
  }
  return ratio;
}

Finding judge_code(const record::Record& record, const CodeComparison& comparison,
                   const AdviceWithCommand& accept_advice) {
  Observation observation{.cause = Cause::as_stored,
                          .against = Against::baseline,
                          .numbers = {{"values", static_cast<double>(record.code.size())}}};
  if (!comparison.changes.empty()) {
    observation.cause = Cause::values_changed;
    observation.numbers = {{"ratio", ratio_of(comparison)}};
    observation.changes = changes_of(comparison);
  } else if (has_other_executables(comparison)) {
    observation.cause = Cause::other_executables;
    observation.numbers.clear();
  }
  observation.names = comparison.removed;
  observation.names.insert(observation.names.end(), comparison.added.begin(),
                           comparison.added.end());
  const Verdict verdict = verdict_of(comparison);
  return finding_about(record, Check::code, verdict, std::move(observation),
                       verdict == Verdict::cannot_judge ? accept_advice : AdviceWithCommand{});
}

class DeviceCodeCheck {
 public:
  DeviceCodeCheck(const RunView& view, const record::Device& device)
      : view_(view), device_(device), stored_(view.baselines.code(device)) {}

  void add_record(const record::Record& record) { records_.push_back(&record); }

  void finish(std::vector<Finding>& findings) {
    if (stored_ == nullptr) return report_other_driver(findings);
    for (const record::Record* record : records_) compare(*record, findings);
    if (!not_stored_.empty()) {
      add(findings, Verdict::cannot_judge, {.cause = Cause::not_stored, .names = not_stored_},
          view_.accept_advice());
    }
    if (!reassembled_.empty()) {
      add(findings, Verdict::advisory, {.cause = Cause::other_disassembly, .names = reassembled_});
    }
  }

 private:
  void add(std::vector<Finding>& findings, Verdict verdict, Observation observation,
           AdviceWithCommand advice = {}) const {
    findings.push_back(finding_about(view_, device_, Check::code, verdict, std::move(observation),
                                     std::move(advice)));
  }

  // Compares the code statistics with those of another driver version. Reports only totals, because
  // the compilers differ.
  void report_other_driver(std::vector<Finding>& findings) const {
    const DriverCode* other = nullptr;
    for (const auto& [driver, code] : view_.baselines.code_of_all_drivers()) {
      if (code.device == device_.id) other = &code;
    }
    if (other == nullptr) {
      return add(findings, view_.not_stored_verdict(), {.cause = Cause::no_stored_device},
                 view_.accept_advice(Advice::accept_or_compare));
    }
    CodeTotals totals;
    for (const record::Record* record : records_) {
      const auto other_code = other->configurations.find(record->configuration);
      if (other_code != other->configurations.end()) {
        totals.add(record->configuration, other_code->second, record->code);
      }
    }
    add(findings, view_.not_stored_verdict(),
        {.cause = Cause::other_compiler,
         .against = Against::other_devices,
         .numbers = {{"configurations", static_cast<double>(totals.configurations())},
                     {"changed", static_cast<double>(totals.changed())}},
         .changes = changes_of(totals),
         .facts = {{"driver_version", device_.driver_version},
                   {"other_version", other->driver_version}}},
        view_.accept_advice(Advice::accept_or_compare));
  }

  void compare(const record::Record& record, std::vector<Finding>& findings) {
    const auto stored = stored_->configurations.find(record.configuration);
    if (stored == stored_->configurations.end()) {
      not_stored_.push_back(record.configuration);
      return;
    }
    const CodeComparison comparison = compare_code(stored->second, record.code);
    findings.push_back(judge_code(record, comparison, view_.accept_advice()));
    if (comparison.changes.empty() && !comparison.reassembled.empty()) {
      reassembled_.push_back(record.configuration);
    }
  }

  const RunView& view_;
  const record::Device& device_;
  const DriverCode* stored_;  // the stored code of this driver version; may be nullptr
  std::vector<const record::Record*> records_;
  std::vector<std::string> not_stored_;
  std::vector<std::string> reassembled_;  // configurations with only a changed disassembly
};

}  // namespace

std::vector<Finding> check_code(const RunView& view) {
  std::map<std::string, DeviceCodeCheck> devices;
  for (const record::Record* record : view.measured) {
    if (record->code.empty()) continue;
    devices.try_emplace(record->device, view, view.device(*record))
        .first->second.add_record(*record);
  }
  std::vector<Finding> findings;
  for (auto& [id, check] : devices) check.finish(findings);
  return findings;
}

}  // namespace triptych::judge
