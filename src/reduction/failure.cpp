#include "reduction/failure.hpp"

#include <utility>

#include "accuracy/image_metrics.hpp"
#include "judge/gate/counter_changes.hpp"
#include "judge/image_observation.hpp"

namespace triptych::reduction {
namespace {

std::optional<judge::Observation> image_fault(const record::Record& record,
                                              const Evidence& evidence) {
  if (record.image.empty()) return std::nullopt;
  const judge::TruthPair pair = evidence.truth(record);
  const core::Image image = evidence.image(record);
  judge::Observation observation =
      judge::image_observation(accuracy::compare(image, pair.truth, pair.bound), image, pair.truth,
                               judge::Against::reference);
  if (observation.cause == judge::Cause::within_bound) return std::nullopt;
  return observation;
}

std::vector<judge::Change> counter_changes(const record::Record& record, const Evidence& evidence) {
  if (!evidence.other) return {};
  const record::Record other = evidence.other(record);
  if (other.outcome != record::Outcome::measured) return {};
  judge::StoredCounters counted;
  for (const auto& [name, value] : other.counters) counted[name][other.device] = value;
  return judge::counter_changes(record, counted, evidence.open_counts);
}

}  // namespace

bool is_same_kind(const Failure& a, const Failure& b) {
  if (a.cause == judge::Cause::values_changed) return b.cause == a.cause;
  return judge::kind_of(a) == judge::kind_of(b);
}

std::optional<Failure> failure_of(const record::Record& record, const Evidence& evidence) {
  using judge::Cause;
  if (record.outcome == record::Outcome::skipped) return std::nullopt;
  if (record.outcome != record::Outcome::measured) {
    return Failure{.cause = Cause::ended, .outcome = record.outcome, .reason = record.reason};
  }
  if (auto wrong = image_fault(record, evidence)) return wrong;
  if (auto changed = counter_changes(record, evidence); !changed.empty()) {
    return Failure{.cause = Cause::values_changed,
                   .against = judge::Against::other_devices,
                   .changes = std::move(changed)};
  }
  return std::nullopt;
}

}  // namespace triptych::reduction
