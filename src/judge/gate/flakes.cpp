#include "judge/gate/flakes.hpp"

#include <algorithm>
#include <optional>

#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

std::pair<std::string, std::string> case_of(const Finding& finding) {
  return {finding.device, finding.configuration};
}

bool is_of_one_configuration(const Finding& finding) {
  return !finding.device.empty() && !finding.configuration.empty();
}

bool is_correct(Verdict verdict) {
  return verdict == Verdict::pass || verdict == Verdict::improved || verdict == Verdict::advisory;
}

// Returns the result that the file of expectations (the list of known failures that `validate`
// writes) should contain for this finding. nullopt means that the configuration should pass and
// needs no entry.
std::optional<ExpectedOutcome> expected_outcome_of(const Finding& finding) {
  if (finding.verdict == Verdict::skipped) return ExpectedOutcome::skip;
  if (finding.verdict == Verdict::regression) {
    return finding.retry_result == RetryResult::flake ? ExpectedOutcome::flake
                                                      : ExpectedOutcome::fail;
  }
  const bool known =
      finding.verdict == Verdict::waived && finding.excuse.kind == Excuse::Kind::known;
  return known ? std::optional(finding.excuse.outcome) : std::nullopt;
}

// Returns the finding about a regression that did not recur in the second attempt. It becomes a
// flake. A timeout, however, becomes a finding that cannot be judged, because the driver may just
// be slow.
Finding passed_retry(const Finding& finding) {
  Finding retry = finding;
  retry.retry_result = RetryResult::flake;
  if (finding.reason.limit()) {
    retry.verdict = Verdict::cannot_judge;
    retry.retry_result = RetryResult::slow;
    retry.advice = {Advice::more_time};
  }
  return retry;
}

// Merges a regression with the result of the second attempt. If the second attempt has no finding
// of this check for the configuration, it passed. This is the case for a technique without a
// meaningful image, such as speed_of_light (which only fetches voxels), because such a technique
// has a finding only if drawing fails.
void apply_retry(const Finding& finding, SecondAttempt& attempt) {
  std::vector<Finding>& findings = attempt.result.findings;
  const auto retry = std::ranges::find_if(findings, [&](const Finding& each) {
    return each.check == finding.check && case_of(each) == case_of(finding);
  });
  const bool found = retry != findings.end();
  const bool still_fails =
      found && (retry->verdict == Verdict::regression || retry->verdict == Verdict::waived);
  if (still_fails) return;
  Finding merged = finding;
  if (found && !is_correct(retry->verdict)) {
    merged.retry_result = RetryResult::other;
    merged.retry_observations = {*retry};
  } else {
    merged = passed_retry(finding);
    if (merged.verdict == Verdict::regression) attempt.flakes.insert(case_of(finding));
  }
  if (found) *retry = std::move(merged);
  if (!found) findings.push_back(std::move(merged));
}

}  // namespace

CaseSet failing_cases(const GateResult& result) {
  CaseSet cases;
  for (const Finding& finding : result.findings) {
    const bool fails = finding.verdict == Verdict::regression && is_of_one_configuration(finding);
    if (fails) cases.insert(case_of(finding));
  }
  return cases;
}

SecondAttempt mark_flakes(const GateResult& first, GateResult second, const CaseSet& cases) {
  SecondAttempt attempt{std::move(second), {}};
  for (const Finding& finding : first.findings) {
    if (finding.verdict == Verdict::regression && cases.contains(case_of(finding))) {
      apply_retry(finding, attempt);
    }
  }
  sort_findings(attempt.result.findings);
  return attempt;
}

std::vector<Waiver> expected_outcomes_of(
    std::span<const GateResult> results,
    const std::function<std::string(const Finding&)>& reason_of) {
  std::vector<Waiver> expected;
  for (const GateResult& result : results) {
    for (const Finding& finding : result.findings) {
      const auto outcome = expected_outcome_of(finding);
      if (!outcome || !is_of_one_configuration(finding)) continue;
      expected.push_back({.device = finding.device,
                          .test = finding.test,
                          .reason = reason_of(finding),
                          .expiry = {},
                          .configuration = finding.configuration,
                          .outcome = *outcome});
    }
  }
  return expected;
}

}  // namespace triptych::judge
