#pragma once
// Maps values to positions on an axis of a figure.

#include <string>
#include <vector>

#include "report/figures/figure.hpp"

namespace triptych::report {

// An axis and the range of values that it shows. The axis must outlive this object.
class AxisScale {
 public:
  // `low` and `high` are the smallest and largest value of the data, or infinite if there is no
  // data.
  AxisScale(const Axis& axis, double low, double high);

  // Returns the position of a value: 0 at the low end of the axis, 1 at the high end.
  [[nodiscard]] double share(double value) const;

  struct Tick {
    double at;
    std::string text;
    std::string whole = {};  // the full text, if `text` is a shortened version of it
  };
  [[nodiscard]] std::vector<Tick> ticks(int wanted) const;

 private:
  const Axis& axis_;
  double low_;
  double high_;
};

// Returns the width of the longest tick label.
[[nodiscard]] double widest_label(const std::vector<AxisScale::Tick>& ticks);

}  // namespace triptych::report
