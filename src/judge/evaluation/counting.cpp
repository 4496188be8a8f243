#include "judge/evaluation/counting.hpp"

#include <algorithm>
#include <cmath>

namespace triptych::judge {
namespace {

class PairCount {
 public:
  PairCount(const CorrelationPair& pair, const Trial& trial, Tally& tally)
      : pair_(pair), result_(pair.result), trial_(trial), tally_(tally) {}

  void run() {
    if (trial_.spread == Spread::scrambled) {
      tally_.detected.count(!result_.admitted());
      return;
    }
    const bool everything = trial_.spread == Spread::global || trial_.spread == Spread::api;
    configurations();
    levels(everything);
    if (result_.global.slower) {
      name(everything);
      detected_ = detected_ || everything;
    }
    if (!trial_.planted.empty()) {
      tally_.detected.count(detected_);
      const auto caught = must_be_caught(trial_.spread);
      if (caught && trial_.cost >= *caught) tally_.to_be_caught.count(detected_);
      if (!trial_.confirmed) tally_.costs.push_back(trial_.cost);
    }
    tally_.false_alarms.count(alarmed_);
  }

 private:
  // One thing is called slower.
  void name(bool rightly) {
    tally_.false_discoveries.count(!rightly);
    alarmed_ = alarmed_ || !rightly;
  }

  [[nodiscard]] bool is_planted(const CorrelationCase& each) const {
    return trial_.planted.contains({pair_.device, each.configuration});
  }

  void configurations() {
    const bool one = trial_.spread == Spread::configuration;
    double largest_share = -1;
    bool first_is_planted = false;
    for (std::size_t i = 0; i < pair_.cases.size(); ++i) {
      const CorrelationCase& each = pair_.cases[i];
      if (each.anchor) continue;
      if (!trial_.confirmed) {
        tally_.undecided.count(!result_.admitted());
        ++tally_.configurations;
      }
      const ConfigurationJudgement& judgement = result_.judgements.at(i);
      const bool slower = result_.admitted() && judgement.slower && !judgement.standing;
      const bool planted = is_planted(each);
      if (one && planted) tally_.found.count(slower);
      if (!slower) continue;
      name(planted);
      detected_ = detected_ || (one && planted);
      if (one && planted) split(each, judgement.residual);
      if (judgement.share > largest_share) {
        largest_share = judgement.share;
        first_is_planted = planted;
      }
    }
    if (one && largest_share >= 0) tally_.first_named.count(first_is_planted);
  }

  void split(const CorrelationCase& each, double residual) {
    if (!each.work) return;
    const bool says_work =
        std::abs(each.work->log_ratio) > std::abs(residual - each.work->log_ratio);
    tally_.split.count(says_work == trial_.more_work);
  }

  [[nodiscard]] bool is_planted(const LevelEffect& level) const {
    const std::string name = trial_.level.first + "=" + trial_.level.second;
    return level.factor + "=" + level.level == name ||
           std::ranges::find(level.aliases, name) != level.aliases.end();
  }

  void levels(bool everything) {
    const bool one = trial_.spread == Spread::level;
    bool first = true;
    for (const LevelEffect& level : result_.levels) {
      if (!level.slower || level.standing) continue;
      const bool planted = one && is_planted(level);
      name(planted || everything);
      detected_ = detected_ || planted;
      if (one && first) tally_.first_named.count(planted);
      first = false;
    }
  }

  const CorrelationPair& pair_;
  const Correlation& result_;
  const Trial& trial_;
  Tally& tally_;
  bool detected_ = false;
  bool alarmed_ = false;
};

void count_pair(TrialKind kind, const CorrelationPair& pair, const GateResult& result,
                const Trial& trial, Tallies& tallies) {
  kind.spread = trial.spread;
  kind.percent = trial.percent;
  kind.confirmed = trial.confirmed;
  Tally& tally = tallies[kind];
  PairCount(pair, trial, tally).run();
  if (!trial.confirmed) tally.in_doubt.count(result.in_doubt.contains(pair.device));
}

}  // namespace

std::set<std::pair<std::string, std::string>> names_of(const std::vector<record::Record>& records) {
  std::set<std::pair<std::string, std::string>> names;
  for (const record::Record& each : records) names.emplace(each.device, each.configuration);
  return names;
}

void count_history(const std::string& plan, const GateResult& result, const Trial& trial,
                   const std::vector<std::string>& devices, Tallies& tallies) {
  if (trial.spread == Spread::scrambled) return;
  const bool everything = trial.spread == Spread::global || trial.spread == Spread::api;
  for (const std::string& device : devices) {
    Tally& tally = tallies[{"history", plan, device, trial.spread, trial.percent, trial.confirmed}];
    bool detected = false;
    bool alarmed = false;
    bool open = false;
    for (const Finding& finding : result.findings) {
      if (finding.check != Check::timing || finding.device != device) continue;
      if (finding.subject == "drift") continue;  // of many runs: no answer about this one
      const bool whole = finding.configuration.empty();
      const bool slower = finding.verdict == Verdict::regression;
      const bool planted =
          whole ? everything : trial.planted.contains({device, finding.configuration});
      if (slower) tally.false_discoveries.count(!planted);
      detected = detected || (slower && planted);
      alarmed = alarmed || (slower && !planted);
      open = open || finding.verdict == Verdict::cannot_judge;
      if (whole) continue;
      if (planted) tally.found.count(slower);
      if (trial.confirmed) continue;
      tally.undecided.count(finding.verdict == Verdict::cannot_judge ||
                            finding.verdict == Verdict::advisory);
      ++tally.configurations;
    }
    if (!trial.planted.empty()) {
      tally.detected.count(detected);
      if (!trial.confirmed) tally.costs.push_back(trial.cost);
    }
    tally.false_alarms.count(alarmed);
    tally.left_open.count(open);
    if (!trial.confirmed) tally.in_doubt.count(result.in_doubt.contains(device));
  }
}

void count_correlations(const std::string& plan, const std::string& method,
                        const GateResult& result, const Trial& trial, Tallies& tallies) {
  for (const CorrelationPair& pair : result.correlations) {
    if (pair.within_run || pair.of_itself) continue;
    count_pair({method, plan, pair.device + " by " + pair.other}, pair, result, trial, tallies);
  }
}

void count_deciding(const std::string& plan, const std::string& method, const std::string& device,
                    const GateResult& result, const Trial& trial, Tallies& tallies) {
  const CorrelationPair* deciding = nullptr;
  for (const CorrelationPair& pair : result.correlations) {
    if (pair.within_run || pair.device != device) continue;
    if (deciding == nullptr || pair.decides) deciding = &pair;
  }
  if (deciding != nullptr) count_pair({method, plan, device}, *deciding, result, trial, tallies);
}

}  // namespace triptych::judge
