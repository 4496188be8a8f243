#include "judge/confirmation.hpp"

#include <algorithm>

#include "judge/run_view.hpp"

namespace triptych::judge {
namespace {

// Slower, and not so already when the device was accepted.
template <typename Judgement>
bool is_news(const Judgement& judgement) {
  return judgement.slower && !judgement.standing;
}

bool names_suspects(const CorrelationPair& pair) {
  const Correlation& result = pair.result;
  return !pair.within_run && result.admitted() &&
         (std::ranges::any_of(result.judgements, is_news<ConfigurationJudgement>) ||
          std::ranges::any_of(result.levels, is_news<LevelEffect>) || is_news(result.global));
}

bool is_slower_again(const Finding& finding, const GateResult& again) {
  return std::ranges::any_of(again.findings, [&](const Finding& other) {
    return other.verdict == Verdict::regression && other.check == finding.check &&
           other.device == finding.device && other.configuration == finding.configuration &&
           other.subject == finding.subject;
  });
}

// nullptr: there is none that judges.
const CorrelationPair* same_pair(const CorrelationPair& pair, const GateResult& again) {
  const auto own = std::ranges::find_if(again.correlations, [&](const CorrelationPair& other) {
    return other.within_run == pair.within_run && other.device == pair.device &&
           other.other_key == pair.other_key && other.result.admitted();
  });
  return own == again.correlations.end() ? nullptr : &*own;
}

bool is_slower_again(const CorrelationCase& each, const CorrelationPair& again) {
  for (std::size_t i = 0; i < again.cases.size(); ++i) {
    if (again.cases[i].configuration == each.configuration) {
      return is_news(again.result.judgements[i]);
    }
  }
  return false;
}

bool is_slower_again(const LevelEffect& level, const CorrelationPair& again) {
  return std::ranges::any_of(again.result.levels, [&](const LevelEffect& other) {
    return is_news(other) && other.factor == level.factor && other.level == level.level;
  });
}

void take_back(CorrelationPair& pair, const CorrelationPair* again) {
  Correlation& result = pair.result;
  for (std::size_t i = 0; i < pair.cases.size(); ++i) {
    bool& slower = result.judgements[i].slower;
    slower = slower && again != nullptr && is_slower_again(pair.cases[i], *again);
  }
  for (LevelEffect& level : result.levels) {
    level.slower = level.slower && again != nullptr && is_slower_again(level, *again);
  }
  result.global.slower = result.global.slower && again != nullptr && is_news(again->result.global);
}

}  // namespace

std::set<std::string> suspects(const GateResult& result) {
  std::set<std::string> devices;
  for (const Finding& finding : result.findings) {
    if (is_slower(finding)) devices.insert(finding.device);
  }
  return devices;
}

bool names_suspects(const GateResult& result) {
  return !suspects(result).empty() ||
         std::ranges::any_of(result.correlations,
                             [](const CorrelationPair& pair) { return names_suspects(pair); });
}

void take_back_unconfirmed(GateResult& result, const GateResult& again) {
  for (Finding& finding : result.findings) {
    if (!is_slower(finding) || !again.devices.contains(finding.device)) continue;
    const bool confirmed = is_slower_again(finding, again);
    if (!confirmed) finding.verdict = Verdict::advisory;
    finding.message += confirmed ? "; so too on a fresh launch" : "; not so on a fresh launch";
  }
  for (CorrelationPair& pair : result.correlations) {
    if (again.devices.contains(pair.device) && names_suspects(pair)) {
      take_back(pair, same_pair(pair, again));
    }
  }
  sort_findings(result.findings);
}

}  // namespace triptych::judge
