#include "reduction/trial.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "measure/system/stopwatch.hpp"
#include "report/words/finding.hpp"

namespace triptych::reduction {

Trial::Trial(const measure::Suite& suite, const std::string& device, const std::string& other,
             const measure::RunOptions& options, measure::Truths& truths, record::Store& store)
    : truths_(truths), frames_(suite, device, store, options, interrupts_) {
  if (other.empty()) return;
  measure::RunOptions healthy = options;
  healthy.faults.clear();
  other_.emplace(suite, other, store, healthy, interrupts_);
}

std::optional<Failure> Trial::operator()(const measure::Configuration& configuration) {
  last_ = frames_.draw(configuration);
  return failure_of(last_, evidence(configuration));
}

Evidence Trial::evidence(const measure::Configuration& configuration) {
  Evidence evidence{
      .truth = [this](const record::Record& record) { return truths_.of(record); },
      .picture = [this](const record::Record& record) { return truths_.picture_of(record); },
      .open_counts =
          [this](const record::Record& record) { return truths_.open_counts_of(record); }};
  if (other_) {
    evidence.other = [this, &configuration](const record::Record&) {
      return other_->draw(configuration);
    };
  }
  return evidence;
}

std::optional<Failure> Trial::first(const measure::Configuration& start) {
  std::optional<Failure> first = (*this)(start);
  if (last_.outcome == record::Outcome::skipped) record::require_measured(last_);
  if (!first) return first;
  std::optional<Failure> again = (*this)(start);
  if (again && is_same_kind(*again, *first)) return again;
  throw core::NotSupported(fmt::format(
      "it fails differently when it is drawn again, so it cannot be made smaller: {}; then {}",
      report::words::text_of(*first), again ? report::words::text_of(*again) : "it is right"));
}

std::chrono::seconds limit_by_first_frame(const measure::Suite& suite, const std::string& device,
                                          const measure::Configuration& start,
                                          measure::RunOptions options, record::Store& store) {
  constexpr std::chrono::seconds least{20};
  constexpr int times_as_long = 3;
  options.limit = record::standard_limit;
  measure::InterruptGuard interrupts;
  measure::SingleFrames frames(suite, device, store, options, interrupts);
  const measure::Stopwatch taken;
  const record::Record first = frames.draw(start);
  if (first.outcome == record::Outcome::hung) return least;
  return std::max(least, std::chrono::ceil<std::chrono::seconds>(times_as_long * taken.elapsed()));
}

}  // namespace triptych::reduction
