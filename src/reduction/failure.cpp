#include "reduction/failure.hpp"

#include <fmt/format.h>

#include "accuracy/image_fault.hpp"
#include "accuracy/image_metrics.hpp"
#include "core/text.hpp"
#include "judge/gate/counters_fault.hpp"

namespace triptych::reduction {
namespace {

// Its first clause: those that follow tell of single pixels.
Failure failure(std::string message) {
  std::string kind = core::without_numbers(message.substr(0, message.find(';')));
  return {std::move(message), std::move(kind)};
}

std::string picture_fault(const record::Record& record, const Evidence& evidence) {
  if (record.image.empty()) return {};
  const judge::TruthPair pair = evidence.truth(record);
  const core::Image image = evidence.picture(record);
  return accuracy::image_fault(accuracy::compare(image, pair.truth, pair.bound), image, pair.truth,
                               "the truth");
}

std::string counters_fault(const record::Record& record, const Evidence& evidence) {
  if (!evidence.other) return {};
  const record::Record other = evidence.other(record);
  if (other.outcome != record::Outcome::measured) return {};
  judge::StoredCounters counted;
  for (const auto& [name, value] : other.counters) counted[name][other.device] = value;
  return judge::counters_fault(record, counted, evidence.open_counts);
}

}  // namespace

std::optional<Failure> failure_of(const record::Record& record, const Evidence& evidence) {
  if (record.outcome == record::Outcome::skipped) return std::nullopt;
  if (record.outcome != record::Outcome::measured) {
    return failure(fmt::format("{}: {}", record::name_of(record.outcome), record.reason));
  }
  if (std::string wrong = picture_fault(record, evidence); !wrong.empty()) {
    return failure(std::move(wrong));
  }
  if (std::string changed = counters_fault(record, evidence); !changed.empty()) {
    return Failure{std::move(changed), std::string(other_counters)};
  }
  return std::nullopt;
}

}  // namespace triptych::reduction
