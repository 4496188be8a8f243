#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "judge/gate/run_view.hpp"
#include "judge/stress/stress.hpp"

namespace triptych::judge {
namespace {

// Returns the smallest allowed score: the accepted score of the device or, for a device without
// baselines, the lowest accepted score of all devices.
std::optional<int> accepted_score(const std::map<std::string, std::uint64_t>& stored,
                                  const std::string& device) {
  const auto own = stored.find(device);
  if (own != stored.end()) return static_cast<int>(own->second);
  const auto least =
      std::ranges::min_element(stored, {}, [](const auto& each) { return each.second; });
  return least == stored.end() ? std::nullopt : std::optional(static_cast<int>(least->second));
}

Verdict verdict_of(int points, std::optional<int> accepted) {
  if (!accepted) return Verdict::cannot_judge;
  if (points < *accepted) return Verdict::regression;
  if (points > *accepted) return Verdict::improved;
  // A case with an unchanged score is reported as an advisory, unless it has the full score.
  return points == best_stress_score ? Verdict::pass : Verdict::advisory;
}

Finding judge(const RunView& view, const ScoredRecord& scored) {
  const record::Record& record = *scored.record;
  const int points = scored.score.points();
  const auto accepted = accepted_score(view.baselines.scores(record.configuration), record.device);
  Observation observation{.cause = Cause::score,
                          .against = Against::baseline,
                          .numbers = {{"score", points}, {"best", best_stress_score}},
                          .outcome = record.outcome,
                          .reason = record.reason,
                          .because = scored.score.lost_points};
  if (accepted) observation.numbers["accepted"] = *accepted;
  return finding_about(record, Check::stress, verdict_of(points, accepted), std::move(observation),
                       accepted ? AdviceWithCommand{} : view.accept_advice());
}

// Returns whether a planned configuration has no record on one of the devices, because the run was
// interrupted or is still going on. Such a configuration is reported as missing.
bool is_unfinished(const RunView& view, const std::vector<record::Record>& records) {
  const std::size_t planned = view.store.planned(view.run).size();
  std::map<std::string, std::size_t> record_counts;
  for (const record::Record& record : records) ++record_counts[record.device];
  return std::ranges::any_of(record_counts,
                             [planned](const auto& device) { return device.second < planned; });
}

}  // namespace

std::vector<Finding> check_stress(const RunView& view) {
  std::vector<Finding> findings;
  if (view.records.empty()) return findings;
  if (!view.request.truth) {
    findings.push_back(
        finding_about(view, Check::stress, Verdict::cannot_judge, {.cause = Cause::no_reference}));
    return findings;
  }
  // Loads the records of all devices, because the images of the judged devices are also compared
  // with the images of devices that are not judged.
  std::vector<record::Record> all = view.store.records(view.records.front().run);
  std::erase_if(all,
                [&](const record::Record& record) { return record.plan != view.request.plan; });
  const StressTruths truths{view.request.truth, view.request.expectations,
                            view.request.part || is_unfinished(view, all)};
  for (const ScoredRecord& scored : score_stress(view.store, all, truths)) {
    if (view.devices.contains(scored.record->device)) findings.push_back(judge(view, scored));
  }
  return findings;
}

}  // namespace triptych::judge
