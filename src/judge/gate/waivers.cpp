#include <algorithm>

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

// Returns whether the waiver covers any configuration and check that this gate judged. A waiver for
// another plan covers none.
bool concerns_run(const Waiver& waiver, const RunView& view) {
  return std::ranges::any_of(view.records, [&](const record::Record& record) {
    return std::ranges::any_of(view.checks, [&](Check check) {
      return covers(waiver, record.device, record.test_id(name_of(check)), record.configuration);
    });
  });
}

// Returns whether the waiver names this plan, but matches no test of it.
bool matches_no_test(const Waiver& waiver, const RunView& view) {
  const record::Checks checks = record::every_check();
  const std::string image = view.plan_test_id(Check::image);
  const std::string plan = image.substr(0, image.rfind('.') + 1);
  return waiver.test.starts_with(plan) &&
         std::ranges::none_of(view.records, [&](const record::Record& record) {
           return std::ranges::any_of(checks, [&](Check check) {
             return core::glob_matches(waiver.test, record.test_id(name_of(check)));
           });
         });
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
  for (const Waiver& waiver : view.baselines.waivers(view.today())) {
    bool used = false;
    for (Finding& finding : findings) {
      if (finding.verdict != Verdict::regression ||
          !covers(waiver, finding.device, finding.test, finding.configuration)) {
        continue;
      }
      used = true;
      const bool expired = has_expired(waiver, view);
      finding.excuse = {.kind = expired ? Excuse::Kind::expired : Excuse::Kind::waived,
                        .reason = waiver.reason,
                        .expiry = waiver.expiry};
      if (!expired) finding.verdict = Verdict::waived;
    }
    const auto advise = [&](Cause cause, Advice advice) {
      findings.push_back(finding_about(
          view, *view.checks.begin(), Verdict::advisory,
          {.cause = cause,
           .facts = {{"test", waiver.test}, {"device", waiver.device}, {"expiry", waiver.expiry}},
           .detail = waiver.reason},
          {advice}));
    };
    if (!used && has_expired(waiver, view) && concerns_run(waiver, view)) {
      advise(Cause::unused_waiver, Advice::remove_waiver);
    }
    if (matches_no_test(waiver, view)) advise(Cause::waiver_of_no_test, Advice::none);
  }
}

}  // namespace triptych::judge
