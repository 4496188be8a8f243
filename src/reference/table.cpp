#include "reference/table.hpp"

#include <algorithm>
#include <cmath>

namespace triptych::reference {

Table::Table(const scene::TransferFunction& function, double table_error)
    : table_error_(table_error) {
  std::size_t visible = entries;
  for (std::size_t k = entries; k-- > 0;) {
    for (std::size_t channel = 0; channel < 4; ++channel) {
      rgba_[k][channel] = static_cast<double>(function.entries[k][channel]);
    }
    if (rgba_[k][3] > 0.0) visible = k;
    next_visible_[k] = visible;
  }
}

double Table::position(double x) {
  const double u = knot_of(x);
  return u > 0.0 ? std::min(u, 255.0) : 0.0;
}

std::array<double, 4> Table::at(double x) const {
  const double u = position(x);
  const std::size_t k = std::min<std::size_t>(static_cast<std::size_t>(u), entries - 2);
  const double f = u - static_cast<double>(k);
  const std::array<double, 4>& a = rgba_[k];
  const std::array<double, 4>& b = rgba_[k + 1];
  return {a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2]),
          a[3] + f * (b[3] - a[3])};
}

Looked Table::look_up(const Bounded& x) const {
  const std::array<double, 4> centre = at(x.value);
  std::array<double, 4> lo = centre;
  std::array<double, 4> hi = centre;
  if (x.error > 0.0) {
    const auto widen = [&](const std::array<double, 4>& rgba) {
      for (std::size_t channel = 0; channel < 4; ++channel) {
        lo[channel] = std::min(lo[channel], rgba[channel]);
        hi[channel] = std::max(hi[channel], rgba[channel]);
      }
    };
    widen(at(x.value - x.error));
    widen(at(x.value + x.error));
    const auto first = static_cast<std::size_t>(position(x.value - x.error)) + 1;
    const auto last = static_cast<std::size_t>(position(x.value + x.error));
    for (std::size_t k = first; k <= last; ++k) widen(rgba_[k]);
  }
  Looked looked;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    looked.colour[channel] = centre[channel];
    looked.colour_error[channel] =
        std::max(hi[channel] - centre[channel], centre[channel] - lo[channel]) + table_error_;
  }
  looked.alpha = centre[3];
  looked.alpha_lo = std::max(lo[3] - table_error_, 0.0);
  looked.alpha_hi = std::min(hi[3] + table_error_, 1.0);
  return looked;
}

bool Table::transparent(const Bounded& x) const {
  const auto first = static_cast<std::size_t>(position(x.value - x.error));
  const auto last = static_cast<std::size_t>(std::ceil(position(x.value + x.error)));
  return next_visible_[first] > last;
}

}  // namespace triptych::reference
