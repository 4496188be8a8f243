#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/glob.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

// Returns whether the waiver applies to a finding. `configuration` is empty for a finding about a
// whole device or plan.
bool covers(const Waiver& waiver, const std::string& device, const std::string& test,
            const std::string& configuration) {
  return core::glob_matches(waiver.device, device) && core::glob_matches(waiver.test, test) &&
         core::glob_matches(waiver.configuration, configuration);
}

bool has_expired(const Waiver& waiver, const RunView& view) {
  return !waiver.expiry.empty() && view.today() >= waiver.expiry;
}

// Returns the entry of GateRequest::known that covers the finding and is of one of these kinds, or
// nullptr if there is none.
const Waiver* find_expected_outcome(const RunView& view, const Finding& finding,
                                    const std::set<ExpectedOutcome>& kinds) {
  const auto found = std::ranges::find_if(*view.request.expected_outcomes, [&](const Waiver& each) {
    return kinds.contains(each.outcome) && !has_expired(each, view) &&
           covers(each, finding.device, finding.test, finding.configuration);
  });
  return found == view.request.expected_outcomes->end() ? nullptr : &*found;
}

void compare_with_expected(const RunView& view, Finding& finding) {
  switch (finding.verdict) {
    case Verdict::regression:
      if (const Waiver* known = find_expected_outcome(
              view, finding, {ExpectedOutcome::fail, ExpectedOutcome::flake})) {
        finding.verdict = Verdict::waived;
        finding.excuse = {
            .kind = Excuse::Kind::known, .outcome = known->outcome, .reason = known->reason};
      }
      break;
    case Verdict::skipped:
      if (find_expected_outcome(view, finding, {ExpectedOutcome::skip}) == nullptr) {
        finding.verdict = Verdict::cannot_judge;
        finding.excuse = {.kind = Excuse::Kind::unexpected, .outcome = ExpectedOutcome::skip};
      }
      break;
    case Verdict::pass:
    case Verdict::improved:
      if (const Waiver* known = find_expected_outcome(
              view, finding, {ExpectedOutcome::fail, ExpectedOutcome::skip})) {
        finding.verdict = Verdict::improved;
        finding.excuse = {
            .kind = Excuse::Kind::unexpected, .outcome = known->outcome, .reason = known->reason};
        finding.advice = {Advice::remove_entry};
      }
      break;
    default:
      break;
  }
}

// Returns whether the check can have regressions. Times have none, unless they affect the verdict.
bool can_regress(const RunView& view, Check check) {
  return check != Check::timing || view.request.times_decide;
}

// Returns whether the waiver covers any configuration and check that this gate judged. A waiver for
// another plan covers none.
bool concerns_run(const Waiver& waiver, const RunView& view) {
  return std::ranges::any_of(view.records, [&](const record::Record& record) {
    return std::ranges::any_of(view.checks, [&](Check check) {
      return covers(waiver, record.device, record.test_id(name_of(check)), record.configuration);
    });
  });
}

// Returns the beginning of all test ids of the plan: "volume.quick.".
std::string test_prefix(const RunView& view) {
  return view.records.empty() ? view.plan_test_prefix() : view.records.front().test_prefix();
}

bool names_test_of(const Waiver& waiver, std::string_view prefix, Check check,
                   const std::string& device) {
  return core::glob_matches(waiver.test, fmt::format("{}{}.{}", prefix, name_of(check), device));
}

std::set<std::string> accepted_devices(const RunView& view) {
  std::set<std::string> devices;
  if (!view.baselines.present()) return devices;
  for (const auto& [id, drivers] : view.baselines.manifest().devices) devices.insert(id);
  return devices;
}

// Returns whether this run judged everything that the waiver can excuse: the waiver names this
// plan, the whole plan was judged, and nothing is missing on any device or in any check that the
// waiver names. Otherwise, the waiver may be needed elsewhere, such as on another machine.
bool is_covered(const Waiver& waiver, const RunView& view, const std::vector<Finding>& findings) {
  const std::string prefix = test_prefix(view);
  if (view.request.part || !waiver.test.starts_with(prefix)) return false;
  const bool incomplete = std::ranges::any_of(findings, [&](const Finding& finding) {
    return (finding.verdict == Verdict::cannot_judge ||
            record::lacks_data(finding.outcome, finding.reason)) &&
           (finding.device.empty() || core::glob_matches(waiver.device, finding.device));
  });
  if (incomplete) return false;
  std::set<std::string> measured;
  for (const record::Record& record : view.records) measured.insert(record.device);
  std::set<std::string> devices = accepted_devices(view);
  devices.insert(measured.begin(), measured.end());
  record::Checks checks = checks_of_run(view.run);
  checks.insert(view.checks.begin(), view.checks.end());
  bool any = false;
  for (const std::string& device : devices) {
    if (!core::glob_matches(waiver.device, device)) continue;
    for (const Check check : checks) {
      if (!can_regress(view, check) || !names_test_of(waiver, prefix, check, device)) continue;
      if (!measured.contains(device) || !view.checks.contains(check)) return false;
      any = true;
    }
  }
  return any;
}

// Returns whether the waiver names this plan, but matches no test of it on any known device.
bool matches_no_test(const Waiver& waiver, const RunView& view) {
  const std::string prefix = test_prefix(view);
  if (!waiver.test.starts_with(prefix)) return false;
  std::set<std::string> devices = accepted_devices(view);
  for (const record::Record& record : view.records) devices.insert(record.device);
  if (devices.empty()) return false;
  devices.insert(waiver.device);  // it may be the id of a device of another machine
  const record::Checks checks = record::every_check();
  return std::ranges::none_of(devices, [&](const std::string& device) {
    return std::ranges::any_of(
        checks, [&](Check check) { return names_test_of(waiver, prefix, check, device); });
  });
}

// Returns the plan that the waiver names without wildcards, such as "volume/quick", if neither
// such a plan nor baselines for it exist. Otherwise, returns "".
std::string unknown_plan_of(const Waiver& waiver, const RunView& view) {
  const std::string& test = waiver.test;
  const std::size_t end = test.find('.', test.find('.') + 1);
  const bool is_literal = end != std::string::npos && test.find_first_of("*?") > end;
  if (!is_literal || view.request.known_plans.empty()) return {};
  if (test.starts_with(test_prefix(view))) return {};
  std::string plan = test.substr(0, end);
  plan[plan.find('.')] = '/';
  const std::string file_plan = plan.substr(plan.find('/') + 1);  // a plan from a YAML file
  const bool known = view.request.known_plans.contains(plan) || view.baselines.has_plan(plan) ||
                     view.baselines.has_plan(file_plan);
  return known ? std::string() : plan;
}

}  // namespace

bool is_waived(const RunView& view, const record::Record& record, Check check) {
  return std::ranges::any_of(view.baselines.waivers(view.today()), [&](const Waiver& waiver) {
    return !has_expired(waiver, view) &&
           covers(waiver, record.device, record.test_id(name_of(check)), record.configuration);
  });
}

void apply_expected_outcomes(const RunView& view, std::vector<Finding>& findings) {
  if (!view.request.expected_outcomes) return;
  for (Finding& finding : findings) {
    if (!finding.configuration.empty()) compare_with_expected(view, finding);
  }
}

void apply_waivers(const RunView& view, std::vector<Finding>& findings) {
  std::vector<Finding> ineffective;
  for (const Waiver& waiver : view.baselines.waivers(view.today())) {
    bool used = false;
    const bool expired = has_expired(waiver, view);
    for (Finding& finding : findings) {
      if (finding.verdict != Verdict::regression ||
          !covers(waiver, finding.device, finding.test, finding.configuration)) {
        continue;
      }
      used = true;
      finding.excuse = {.kind = expired ? Excuse::Kind::expired : Excuse::Kind::waived,
                        .reason = waiver.reason,
                        .expiry = waiver.expiry};
      if (!expired) finding.verdict = Verdict::waived;
    }
    const auto report = [&](Cause cause, Advice advice = Advice::none) {
      ineffective.push_back(finding_about(view, *view.checks.begin(), Verdict::advisory,
                                          {.cause = cause,
                                           .facts = {{"test", waiver.test},
                                                     {"device", waiver.device},
                                                     {"configuration", waiver.configuration},
                                                     {"expiry", waiver.expiry}},
                                           .detail = waiver.reason},
                                          {advice}));
    };
    if (const std::string plan = unknown_plan_of(waiver, view); !plan.empty()) {
      report(Cause::waiver_of_no_plan);
      ineffective.back().facts["plan"] = plan;
    } else if (matches_no_test(waiver, view)) {
      report(Cause::waiver_of_no_test);
    } else if (!used &&
               (expired ? concerns_run(waiver, view) : is_covered(waiver, view, findings))) {
      report(Cause::unused_waiver, Advice::remove_waiver);
      if (expired) ineffective.back().numbers["expired"] = 1;
    }
  }
  std::ranges::move(ineffective, std::back_inserter(findings));
}

}  // namespace triptych::judge
