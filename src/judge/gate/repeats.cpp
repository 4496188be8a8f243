#include "judge/gate/repeats.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

using WorstFindings = std::map<CaseKey, const Finding*>;

WorstFindings worst_findings(const Repetition& repetition) {
  WorstFindings worst;
  for (const GateResult& result : repetition.results) {
    for (const Finding& finding : result.findings) {
      if (finding.device.empty() || finding.configuration.empty()) continue;
      const Finding*& known = worst[{result.plan, finding.device, finding.configuration}];
      if (known == nullptr || known->verdict < finding.verdict) known = &finding;
    }
  }
  return worst;
}

bool is_about(const Finding& finding, const CaseKey& key) {
  return finding.device == key.device && finding.configuration == key.configuration;
}

}  // namespace

std::size_t RepeatedCase::failures() const {
  return static_cast<std::size_t>(std::ranges::count(verdicts, Verdict::regression));
}

bool RepeatedCase::is_flaky() const {
  return failures() > 0 && failures() < verdicts.size();
}

std::vector<RepeatedCase> repeated_cases(std::span<const Repetition> repetitions) {
  std::map<CaseKey, RepeatedCase> cases;
  std::map<CaseKey, std::set<std::string>> images;
  for (const Repetition& repetition : repetitions) {
    for (const auto& [key, finding] : worst_findings(repetition)) {
      RepeatedCase& each = cases[key];
      each.key = key;
      each.verdicts.push_back(finding->verdict);
      if (!each.worst || each.worst->verdict < finding->verdict) each.worst = *finding;
    }
    for (const auto& [key, image] : repetition.images) images[key].insert(image);
  }
  std::vector<RepeatedCase> sorted;
  for (auto& [key, each] : cases) {
    each.images = images[key].size();
    sorted.push_back(std::move(each));
  }
  return sorted;
}

void add_flakes(std::span<const RepeatedCase> cases, std::vector<GateResult>& first) {
  for (const RepeatedCase& each : cases) {
    if (!each.is_flaky()) continue;
    const auto result = std::ranges::find(first, each.key.plan, &GateResult::plan);
    if (result == first.end()) continue;
    Finding flake = each.worst.value();
    flake.retry_result = RetryResult::flake;
    std::erase_if(result->findings, [&](const Finding& finding) {
      return is_about(finding, each.key) && finding.check == flake.check;
    });
    result->findings.push_back(std::move(flake));
    sort_findings(result->findings);
  }
}

}  // namespace triptych::judge
