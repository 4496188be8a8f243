#pragma once
// Slow drift: each run is hardly slower than the one before it was accepted beside, and after ten
// of them a tenth is gone. Found over a series of runs instead of against its mean.

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych::judge {

struct DriftModel {
  static constexpr std::size_t least_runs = 10;          // a split of fewer has no small p
  static constexpr std::size_t least_segment = 3;        // runs on either side of a change
  static constexpr double share_of_false_alarms = 0.05;  // q of Benjamini–Hochberg
  static constexpr double least_effect = 1.03;
};

// Where a series steps: `at` is the index of the first run after it.
struct ChangePoint {
  std::size_t at = 0;
  double effect = 0;  // median after it − median before it
  double p = 1;
};

// The split that Wilcoxon's rank sum finds least likely, and p of the largest standardised rank sum
// over all splits, from 9999 random orders of as many ranks (199999 where none of them comes near):
// free of the distribution, and one wild run cannot make a step. nullopt below
// DriftModel::least_runs.
[[nodiscard]] std::optional<ChangePoint> change_point(std::span<const double> series);

// ln t of one configuration by run, oldest first; NaN where a run lacks it.
struct DriftSeries {
  std::string device;
  std::vector<double> log_times;
};

struct Drift {
  std::optional<std::size_t> series;  // index; none: the device as a whole
  std::string device;
  ChangePoint change;  // in runs of the device's, `effect` as ln of a ratio
};

// A device's common series is the median over its configurations of each one's deviation from its
// own median; a configuration's is what is left of it. Changes of at least
// DriftModel::least_effect, slower ones only, after Benjamini–Hochberg over all series; devices
// first.
[[nodiscard]] std::vector<Drift> find_drift(std::span<const DriftSeries> series);

}  // namespace triptych::judge
