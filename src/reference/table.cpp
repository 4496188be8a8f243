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

Span Table::span_of(const Bounded& x) {
  const auto clamped = [](double u) { return u > 0.0 ? std::min(u, 255.0) : 0.0; };
  const double centre = knot_of(x.value);
  const double reach = 256.0 * x.error;
  return {clamped(centre), clamped(centre - reach), clamped(centre + reach)};
}

Table::Rgba Table::at(double position) const {
  const std::size_t k = std::min<std::size_t>(static_cast<std::size_t>(position), entries - 2);
  const double f = position - static_cast<double>(k);
  const Rgba& a = rgba_[k];
  const Rgba& b = rgba_[k + 1];
  return {a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2]),
          a[3] + f * (b[3] - a[3])};
}

TableLookup Table::look_up(const Span& span) const {
  const std::size_t k = std::min(static_cast<std::size_t>(span.centre), entries - 2);
  const double f = span.centre - static_cast<double>(k);
  const Rgba& a = rgba_[k];
  const Rgba& b = rgba_[k + 1];
  TableLookup lookup;
  if (span.lo >= static_cast<double>(k) && span.hi <= static_cast<double>(k + 1)) {
    // The function is linear over the whole span, which is nearly always the case.
    const double reach = std::max(span.hi - span.centre, span.centre - span.lo);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double slope = b[channel] - a[channel];
      lookup.colour[channel] = a[channel] + f * slope;
      lookup.colour_error[channel] = reach * std::abs(slope) + table_error_;
    }
    const double slope = b[3] - a[3];
    const double change = reach * std::abs(slope) + table_error_;
    lookup.alpha = a[3] + f * slope;
    lookup.alpha_lo = std::max(lookup.alpha - change, 0.0);
    lookup.alpha_hi = std::min(lookup.alpha + change, 1.0);
    return lookup;
  }
  return look_up_across_entries(span);
}

TableLookup Table::look_up_across_entries(const Span& span) const {
  const Rgba centre = at(span.centre);
  Rgba lo = centre;
  Rgba hi = centre;
  const auto widen = [&](const Rgba& rgba) {
    for (std::size_t channel = 0; channel < 4; ++channel) {
      lo[channel] = std::min(lo[channel], rgba[channel]);
      hi[channel] = std::max(hi[channel], rgba[channel]);
    }
  };
  widen(at(span.lo));
  widen(at(span.hi));
  const auto last = static_cast<std::size_t>(span.hi);
  for (std::size_t k = static_cast<std::size_t>(span.lo) + 1; k <= last; ++k) widen(rgba_[k]);
  TableLookup lookup;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    lookup.colour[channel] = centre[channel];
    lookup.colour_error[channel] =
        std::max(hi[channel] - centre[channel], centre[channel] - lo[channel]) + table_error_;
  }
  lookup.alpha = centre[3];
  lookup.alpha_lo = std::max(lo[3] - table_error_, 0.0);
  lookup.alpha_hi = std::min(hi[3] + table_error_, 1.0);
  return lookup;
}

}  // namespace triptych::reference
