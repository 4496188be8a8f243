#include "reduction/trial.hpp"

#include <algorithm>

#include "measure/system/stopwatch.hpp"

namespace triptych::reduction {

Trial::Trial(const measure::Suite& suite, const std::string& device, const std::string& other,
             const measure::RunOptions& options, measure::Truths& truths, record::Store& store)
    : truths_(truths), replace_worker_([this, &suite, device, &store, options] {
        frames_.emplace(suite, device, store, options, interrupts_);
      }) {
  replace_worker_();
  if (other.empty()) return;
  measure::RunOptions without_faults = options;
  without_faults.faults.clear();
  other_.emplace(suite, other, store, without_faults, interrupts_);
}

std::optional<Failure> Trial::operator()(const measure::Configuration& configuration) {
  last_ = frames_->draw(configuration);
  return failure_of(last_, evidence(configuration));
}

std::optional<Failure> Trial::draw_after(std::span<const measure::Configuration> before,
                                         const measure::Configuration& configuration) {
  frames_.reset();
  replace_worker_();
  for (const measure::Configuration& each : before) static_cast<void>(frames_->draw(each));
  return (*this)(configuration);
}

Evidence Trial::evidence(const measure::Configuration& configuration) {
  Evidence evidence{
      .truth = [this](const record::Record& record) { return truths_.of(record); },
      .image = [this](const record::Record& record) { return truths_.image_of(record); },
      .open_counts =
          [this](const record::Record& record) { return truths_.open_counts_of(record); }};
  if (other_) {
    evidence.other = [this, &configuration](const record::Record&) {
      return other_->draw(configuration);
    };
  }
  return evidence;
}

FirstFrames Trial::draw_first(const measure::Configuration& start) {
  FirstFrames frames{.first_failure = (*this)(start), .second_failure = {}};
  if (last_.outcome == record::Outcome::skipped) record::require_measured(last_);
  if (frames.first_failure) frames.second_failure = (*this)(start);
  return frames;
}

std::chrono::seconds limit_by_first_frame(const measure::Suite& suite, const std::string& device,
                                          const measure::Configuration& start,
                                          measure::RunOptions options, record::Store& store) {
  constexpr std::chrono::seconds least_limit{20};
  constexpr int limit_factor = 3;
  options.limit = record::default_limit;
  measure::InterruptGuard interrupts;
  measure::SingleFrames frames(suite, device, store, options, interrupts);
  const measure::Stopwatch stopwatch;
  const record::Record first = frames.draw(start);
  if (first.outcome == record::Outcome::hung) return least_limit;
  return std::max(least_limit,
                  std::chrono::ceil<std::chrono::seconds>(limit_factor * stopwatch.elapsed()));
}

}  // namespace triptych::reduction
