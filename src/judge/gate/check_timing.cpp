// Compares times with those of the accepted run. Times are always shown, but affect the verdict
// only on request (`--times`).

#include <algorithm>
#include <cmath>
#include <optional>

#include "estimation/statistics.hpp"
#include "judge/baselines/work.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

const double tolerated = std::log(1.02);  // a smaller slowdown is not a regression

// The ratio of a time to the stored time.
struct Ratio {
  const record::Record* record;
  double log_ratio = 0;
  double half_width = 0;  // half the width of the 95 % confidence interval of log_ratio
};

// Returns the clock of the stored time if the record was also timed by that clock. Every frame is
// timed by the wall clock, even if it is also timed by the device clock. Returns nullopt if the
// times cannot be compared.
std::optional<std::string_view> common_clock(const record::Record& record,
                                             const StoredTiming& stored) {
  if (stored.clock == record.clock()) return record.clock();
  if (stored.clock == "wall" && !record.wall_ns.empty()) return "wall";
  return std::nullopt;
}

Ratio ratio_of(const record::Record& record, std::string_view clock, const StoredTiming& stored) {
  constexpr double normal_quantile = 1.96;
  const std::vector<double>& times = record.time_ns_by(clock);
  return {&record, std::log(estimation::median(times) / stored.median_ns),
          normal_quantile * std::hypot(log_spread(times), stored.spread)};
}

class DeviceTimingCheck {
 public:
  DeviceTimingCheck(const RunView& view, const record::Device& device, const WrongImages& wrong)
      : view_(view), device_(device), wrong_(wrong), stored_(view.baselines.timings(device)) {}

  void check_record(const record::Record& record) {
    const auto wrong = wrong_.find({record.device, record.configuration});
    if (record.untimed()) {
      add(record, Verdict::skipped, {.cause = Cause::untimed});
    } else if (!record.same_as.empty()) {
      add(record, Verdict::skipped, {.cause = Cause::same_frames, .reason = record.reason});
    } else if (wrong != wrong_.end()) {
      add_wrong(record, wrong->second);
    } else if (!has_valid_median(record.time_ns())) {
      add(record, Verdict::cannot_judge, {.cause = Cause::no_time}, {Advice::run_again});
    } else {
      compare(record);
    }
  }

  std::vector<Finding> finish() && {
    // If times affect the verdict, a time that cannot be compared must not pass.
    const Verdict missing = times_decide() ? Verdict::cannot_judge : Verdict::advisory;
    if (!not_stored_.empty() && stored_.empty()) {
      add(missing, {.cause = Cause::no_stored_device, .facts = {{"device_key", device_.key()}}});
    } else if (!not_stored_.empty()) {
      add(missing, {.cause = Cause::not_stored, .names = not_stored_}, view_.accept_advice());
    }
    if (!other_clock_.empty()) add(missing, {.cause = Cause::other_clock, .names = other_clock_});
    summarise();
    return std::move(findings_);
  }

 private:
  [[nodiscard]] bool times_decide() const { return view_.request.times_decide; }
  void add(const record::Record& record, Verdict verdict, Observation observation,
           AdviceWithCommand advice = {}) {
    findings_.push_back(
        finding_about(record, Check::timing, verdict, std::move(observation), std::move(advice)));
  }
  void add(Verdict verdict, Observation observation, AdviceWithCommand advice = {}) {
    findings_.push_back(finding_about(view_, device_, Check::timing, verdict,
                                      std::move(observation), std::move(advice)));
  }
  static bool has_valid_median(const std::vector<double>& times) {
    const double median = estimation::median(times);  // NaN if there are no times
    return std::isfinite(median) && median > 0;
  }

  // If the image is also judged, or if its error is waived, the finding about the image determines
  // the verdict, and the time is skipped.
  void add_wrong(const record::Record& record, const Observation& image_error) {
    const bool is_reported =
        view_.checks.contains(Check::image) || is_waived(view_, record, Check::image);
    add(record, is_reported ? Verdict::skipped : Verdict::cannot_judge,
        {.cause = Cause::wrong_image, .because = {image_error}});
  }

  void compare(const record::Record& record) {
    const auto stored = stored_.find(record.configuration);
    if (stored == stored_.end()) return not_stored_.push_back(record.configuration);
    const auto clock = common_clock(record, stored->second);
    if (!clock) return other_clock_.push_back(record.configuration);
    judge(ratio_of(record, *clock, stored->second), *clock, stored->second);
  }

  // This is the only place where the value of a time affects the verdict.
  [[nodiscard]] Verdict verdict_of(const Ratio& ratio) const {
    if (!times_decide()) return Verdict::pass;
    if (ratio.log_ratio - ratio.half_width > tolerated) return Verdict::regression;
    if (ratio.log_ratio + ratio.half_width < -tolerated) return Verdict::improved;
    return Verdict::pass;
  }

  void judge(const Ratio& ratio, std::string_view clock, const StoredTiming& stored) {
    const record::Record& record = *ratio.record;
    const double now = estimation::median(record.time_ns_by(clock));
    const Verdict verdict = verdict_of(ratio);
    Observation observation{.cause = Cause::time,
                            .against = Against::baseline,
                            .facts = {{"clock", std::string(clock)}}};
    if (const auto work =
            work_change(record.counters, view_.baselines, record.configuration, record.device)) {
      observation.facts["work"] = work->unit;
      set_number(observation, "work_ratio", std::exp(work->log_ratio));
    }
    if (stored.kernel_hash != record.kernel_hash)
      observation.facts["kernel_hash"] = record.kernel_hash;
    add(record, verdict, std::move(observation));
    set_number(findings_.back(), "ratio", std::exp(ratio.log_ratio));
    set_number(findings_.back(), "half_width", ratio.half_width);
    set_number(findings_.back(), "median_ns", now);
    set_number(findings_.back(), "baseline_ns", stored.median_ns);
    ratios_.push_back(ratio);
  }

  void summarise() {
    if (ratios_.empty()) return;
    std::vector<double> logarithms;
    for (const Ratio& ratio : ratios_) logarithms.push_back(ratio.log_ratio);
    const double median = estimation::median(logarithms);
    const Ratio& worst = *std::ranges::max_element(ratios_, {}, &Ratio::log_ratio);
    add(Verdict::advisory,
        {.cause = Cause::times,
         .against = Against::baseline,
         .numbers = {{"configurations", static_cast<double>(ratios_.size())}},
         .facts = {{"configuration", worst.record->configuration}}},
        {times_decide() ? Advice::none : Advice::times});
    set_number(findings_.back(), "ratio", std::exp(median));
    set_number(findings_.back(), "worst_ratio", std::exp(worst.log_ratio));
    set_number(findings_.back(), "worst_half_width", worst.half_width);
  }

  const RunView& view_;
  const record::Device& device_;
  const WrongImages& wrong_;
  const std::map<std::string, StoredTiming>& stored_;
  std::vector<Finding> findings_;
  std::vector<Ratio> ratios_;
  std::vector<std::string> not_stored_;
  std::vector<std::string> other_clock_;
};

}  // namespace

std::vector<Finding> check_timings(const RunView& view, const WrongImages& wrong) {
  std::map<std::string, DeviceTimingCheck> devices;
  for (const record::Record* record : view.measured) {
    devices.try_emplace(record->device, view, view.device(*record), wrong)
        .first->second.check_record(*record);
  }
  std::vector<Finding> findings;
  for (auto& [id, times] : devices) {
    std::ranges::move(std::move(times).finish(), std::back_inserter(findings));
  }
  return findings;
}

}  // namespace triptych::judge
