#include "report/figures/axis_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures/figure_elements.hpp"

namespace triptych::report {

AxisScale::AxisScale(const Axis& axis, double low, double high)
    : axis_(axis), low_(low), high_(high) {
  if (!axis.names.empty()) {
    low_ = -0.5;
    high_ = static_cast<double>(axis.names.size()) - 0.5;
    return;
  }
  if (!(low_ <= high_)) low_ = axis.logarithmic ? 1 : 0, high_ = low_ + 1;
  const double margin =
      axis.logarithmic ? std::max(0.03 * std::log(high_ / low_), 0.02) : 0.03 * (high_ - low_);
  if (axis.logarithmic) {
    low_ *= std::exp(-margin);
    high_ *= std::exp(margin);
  } else if (high_ == low_) {
    const double half = low_ == 0 ? 1 : 0.1 * std::abs(low_);
    low_ -= half;
    high_ += half;
  } else {
    // An axis that begins at 0 gets no margin at that end, because bars begin there.
    if (low_ != 0) low_ -= margin;
    high_ += margin;
  }
  low_ = axis.low.value_or(low_);
  high_ = axis.high.value_or(high_);
}

double AxisScale::share(double value) const {
  const bool logarithmic = axis_.logarithmic && axis_.names.empty();
  return logarithmic ? std::log(value / low_) / std::log(high_ / low_)
                     : (value - low_) / (high_ - low_);
}

std::vector<AxisScale::Tick> AxisScale::ticks(int wanted) const {
  std::vector<Tick> all;
  for (std::size_t i = 0; i < axis_.names.size(); ++i) {
    all.push_back({static_cast<double>(i), shortened(axis_.names[i]), axis_.names[i]});
  }
  if (!all.empty()) return all;
  for (const double value : report::ticks(low_, high_, axis_.logarithmic, wanted)) {
    all.push_back(
        {value, axis_.percent ? fmt::format("{:+.3g} %", 100 * value) : short_number(value)});
  }
  return all;
}

double widest_label(const std::vector<AxisScale::Tick>& ticks) {
  double width = 0;
  for (const auto& tick : ticks) width = std::max(width, width_of(tick.text));
  return width;
}

}  // namespace triptych::report
