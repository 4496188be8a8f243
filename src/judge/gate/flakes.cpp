#include "judge/gate/flakes.hpp"

#include <algorithm>
#include <optional>

#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

std::pair<std::string, std::string> place_of(const Finding& finding) {
  return {finding.device, finding.configuration};
}

bool is_of_one_configuration(const Finding& finding) {
  return !finding.device.empty() && !finding.configuration.empty();
}

bool is_right(Verdict verdict) {
  return verdict == Verdict::pass || verdict == Verdict::improved || verdict == Verdict::advisory;
}

// Returns the result that the file of expectations (the list of known failures that `validate`
// writes) should contain for this finding. nullopt means that the configuration should pass and
// needs no entry.
std::optional<Known> expected_as(const Finding& finding) {
  if (finding.verdict == Verdict::skipped) return Known::skip;
  if (finding.verdict == Verdict::regression) {
    return finding.drawn_again == Again::flake ? Known::flake : Known::fail;
  }
  const bool known = finding.verdict == Verdict::waived && finding.excuse.of == Excuse::Of::known;
  return known ? std::optional(finding.excuse.known) : std::nullopt;
}

// Returns the finding about a regression that did not recur in the second attempt. It becomes a
// flake. A timeout, however, becomes a finding that cannot be judged, because the driver may just
// be slow.
Finding right_again(const Finding& finding) {
  Finding again = finding;
  again.drawn_again = Again::flake;
  if (finding.reason.limit()) {
    again.verdict = Verdict::cannot_judge;
    again.drawn_again = Again::slow;
    again.advice = {Advice::more_time};
  }
  return again;
}

// Merges a regression with the result of the second attempt. If the second attempt has no finding
// of this check for the configuration, it passed. This is the case for a technique without a
// meaningful image, such as speed_of_light (which only fetches voxels), because such a technique
// has a finding only if drawing fails.
void tell_again(const Finding& finding, Redrawn& redrawn) {
  std::vector<Finding>& findings = redrawn.result.findings;
  const auto again = std::ranges::find_if(findings, [&](const Finding& each) {
    return each.check == finding.check && place_of(each) == place_of(finding);
  });
  const bool told = again != findings.end();
  const bool stands =
      told && (again->verdict == Verdict::regression || again->verdict == Verdict::waived);
  if (stands) return;
  Finding now = finding;
  if (told && !is_right(again->verdict)) {
    now.drawn_again = Again::other;
    now.again = {*again};
  } else {
    now = right_again(finding);
    if (now.verdict == Verdict::regression) redrawn.flakes.insert(place_of(finding));
  }
  if (told) *again = std::move(now);
  if (!told) findings.push_back(std::move(now));
}

}  // namespace

Places failing(const GateResult& result) {
  Places places;
  for (const Finding& finding : result.findings) {
    const bool fails = finding.verdict == Verdict::regression && is_of_one_configuration(finding);
    if (fails) places.insert(place_of(finding));
  }
  return places;
}

Redrawn tell_flakes(const GateResult& first, GateResult second, const Places& places) {
  Redrawn redrawn{std::move(second), {}};
  for (const Finding& finding : first.findings) {
    if (finding.verdict == Verdict::regression && places.contains(place_of(finding))) {
      tell_again(finding, redrawn);
    }
  }
  sort_findings(redrawn.result.findings);
  return redrawn;
}

std::vector<Waiver> as_expected(std::span<const GateResult> results,
                                const std::function<std::string(const Finding&)>& reason_of) {
  std::vector<Waiver> expected;
  for (const GateResult& result : results) {
    for (const Finding& finding : result.findings) {
      const auto known = expected_as(finding);
      if (!known || !is_of_one_configuration(finding)) continue;
      expected.push_back({.device = finding.device,
                          .test = finding.test,
                          .reason = reason_of(finding),
                          .expiry = {},
                          .configuration = finding.configuration,
                          .known = *known});
    }
  }
  return expected;
}

}  // namespace triptych::judge
