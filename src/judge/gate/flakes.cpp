#include "judge/gate/flakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "judge/gate/run_view.hpp"
#include "record/hung.hpp"

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

// As what a finding is expected the next time, and why; nothing: as a pass.
std::optional<std::pair<Known, std::string>> expected_as(const Finding& finding) {
  const std::string& message = finding.message;
  if (finding.verdict == Verdict::skipped) return std::pair(Known::skip, message);
  if (finding.verdict == Verdict::regression) {
    if (!message.starts_with(flake_prefix)) return std::pair(Known::fail, message);
    return std::pair(Known::flake, message.substr(flake_prefix.size()));
  }
  if (finding.verdict != Verdict::waived) return std::nullopt;
  for (const Known known : {Known::fail, Known::flake}) {
    const std::string prefix = fmt::format("{}{}: ", known_prefix, name_of(known));
    if (message.starts_with(prefix)) return std::pair(known, message.substr(prefix.size()));
  }
  return std::nullopt;
}

// That `finding` was right the second time: a flake, or a hang that a time cannot tell from a slow
// driver.
Finding right_again(const Finding& finding) {
  Finding again = finding;
  if (record::limit_in(finding.message)) {
    again.verdict = Verdict::cannot_judge;
    again.message += slow_suffix;
  } else {
    again.message.insert(0, flake_prefix);
  }
  return again;
}

// What became of a regression. Where its check says nothing of the place any more, it was the crash
// of what has no finding once it is drawn, such as a picture of speed_of_light.
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
    now.message += fmt::format("; drawn again: {}", again->message);
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

std::vector<Waiver> as_expected(std::span<const GateResult> results) {
  std::vector<Waiver> expected;
  for (const GateResult& result : results) {
    for (const Finding& finding : result.findings) {
      const auto known = expected_as(finding);
      if (!known || !is_of_one_configuration(finding)) continue;
      expected.push_back({.device = finding.device,
                          .test = finding.test,
                          .reason = known->second,
                          .expiry = {},
                          .configuration = finding.configuration,
                          .known = known->first});
    }
  }
  return expected;
}

}  // namespace triptych::judge
