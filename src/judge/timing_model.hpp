#pragma once
// Is a configuration slower than its stored runs on the same device? The numbers behind the timing
// check, free of records and files.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace triptych::judge {

struct TimingModel {
  static constexpr double share_of_false_alarms = 0.05;  // q of Benjamini–Hochberg
  static constexpr std::size_t least_runs = 5;           // fewer stored runs decide nothing
  static constexpr double tolerated = 1.02;  // slower by this factor is not worth a finding
  // A configuration passes only where a slowdown by this factor can be excluded; where noise or a
  // coarse clock leave it possible, nothing is decided.
  static constexpr double must_be_told = 1.20;
};

struct TimingCase {
  std::string device;
  bool anchor = false;
  bool witness = false;  // an anchor of another plan: tells the shift, is not judged itself
  double median_ns = 0;
  std::map<std::string, double> stored_ns;  // run → median; at least TimingModel::least_runs
  double tolerance = 0;                     // τ in ln t: max(ln 1.02, one step of the clock)
};

struct TimingJudgement {
  double baseline_ns = 0;     // geometric mean of the stored runs
  double log_ratio = 0;       // x − shift − x̄
  double shift = 0;           // of the device's anchors in ln t; 0 without anchors
  std::size_t anchors = 0;    // the shift rests on
  double standard_error = 0;  // of log_ratio
  double degrees = 0;         // of freedom of its t distribution, may be infinite
  double t = 0;               // against "slower by τ"
  double p_slower = 1;
  double p_faster = 1;
  double half_width = 0;  // of the one-sided 95 % interval of log_ratio
  bool slower = false;    // both after Benjamini–Hochberg over all cases
  bool faster = false;
  [[nodiscard]] bool too_noisy(double tolerance) const;
};

// One judgement per case, in order; of witnesses it says nothing. With y = ln t: the anchors'
// median deviation of each run (the stored ones and this one) is taken from all of the device's
// cases; variances between stored runs are moderated over the device's cases; t = (x − shift − x̄ −
// τ)/√(s̃²(1 + 1/H) + v), v the variance of the shift.
[[nodiscard]] std::vector<TimingJudgement> judge_timings(std::span<const TimingCase> cases);

}  // namespace triptych::judge
