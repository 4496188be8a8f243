#pragma once
// The change of the frame times between two single runs, and how much of it chance can explain.

#include <optional>
#include <span>

namespace triptych::comparison {

// The median frame times of one configuration in two runs, measured by the same clock.
struct TimePair {
  double before_ns;
  double now_ns;
  double spread_before;  // judge::log_spread of the frame times
  double spread_now;
};

struct TimeChange {
  double ratio;       // the geometric mean of now / before
  double half_width;  // half the width of the 95 % interval of ln(ratio)

  // Returns whether the interval contains the ratio 1.
  [[nodiscard]] bool is_noise() const;
};

// Returns nullopt if there are no pairs.
//
// The spread σ of ln(now / before) of one configuration is estimated in two ways, and the larger
// estimate is used. The first is √(s₀² + s₁²), where s₀ and s₁ are the spreads of the frames in the
// two runs, each at least the spread between undisturbed processes (judge::log_spread); its mean
// over the configurations is used. The second is the standard deviation of ln(now / before) over
// the configurations. It also contains load that changes while a run is measured. The half-width is
// 1.96 σ, and not 1.96 σ / √n for n configurations, because the configurations of one run are
// measured one after the other on the same machine, so their disturbances are not independent.
[[nodiscard]] std::optional<TimeChange> time_change(std::span<const TimePair> pairs);

}  // namespace triptych::comparison
