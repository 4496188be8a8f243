#pragma once
// Maps the values of a figure's axis to positions.

#include <string>
#include <vector>

#include "report/figures/figure.hpp"

namespace triptych::report {

// One axis with its ends. The axis must outlive it.
class AxisScale {
 public:
  // `low` and `high` are the extremes of the data, or infinite if there are none.
  AxisScale(const Axis& axis, double low, double high);

  // The position of a value: 0 at the low end and 1 at the high end.
  [[nodiscard]] double share(double value) const;

  struct Tick {
    double at;
    std::string text;
    std::string whole = {};  // the unshortened text, if it was shortened
  };
  [[nodiscard]] std::vector<Tick> ticks(int wanted) const;

 private:
  const Axis& axis_;
  double low_;
  double high_;
};

// The width of the longest text of the ticks.
[[nodiscard]] double widest_text(const std::vector<AxisScale::Tick>& ticks);

}  // namespace triptych::report
