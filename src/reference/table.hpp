#pragma once
// Looks up the transfer function for a normalised value, or its range over an interval of values.

#include <array>
#include <cstddef>

#include "reference/field.hpp"
#include "scene/transfer_function.hpp"

namespace triptych::reference {

// The result of looking up a value, and the possible results if the value has an error.
struct TableLookup {
  std::array<double, 3> colour{};        // not premultiplied
  std::array<double, 3> colour_error{};  // largest difference from `colour`
  double alpha = 0;                      // per voxel length
  double alpha_lo = 0;
  double alpha_hi = 0;
};

// A value and the ends of the interval that contains it, as positions in the table, in which entry
// k is centred at k.
struct Span {
  double centre = 0;
  double lo = 0;
  double hi = 0;
};

class Table {
 public:
  Table(const scene::TransferFunction& function, double table_error);

  // Returns the position of x in the table, without clamping. The kinks of the function are at 0 …
  // 255.
  [[nodiscard]] static double knot_of(double x) { return x * 256.0 - 0.5; }
  [[nodiscard]] static Span span_of(const Bounded& x);

  // Returns the extremes of the piecewise linear function over the span, widened by table_error.
  // All entries in the span are taken into account, so that no kink or spike is missed.
  [[nodiscard]] TableLookup look_up(const Span& span) const;

  // Returns whether every entry that contributes anywhere in the span is completely transparent.
  // table_error does not matter here, because interpolating zeros gives zero in any arithmetic.
  [[nodiscard]] bool transparent(const Span& span) const {
    const auto last = static_cast<std::size_t>(span.hi);
    const std::size_t above = static_cast<double>(last) < span.hi ? last + 1 : last;
    return next_visible_[static_cast<std::size_t>(span.lo)] > above;
  }

  using Rgba = std::array<double, 4>;
  // Returns the colour (not premultiplied) and the opacity per voxel length at a position from 0 to
  // 255.
  [[nodiscard]] Rgba at(double position) const;

 private:
  static constexpr std::size_t entries = 256;
  [[nodiscard]] TableLookup look_up_across_entries(const Span& span) const;

  std::array<Rgba, entries> rgba_{};
  // For each entry, the first entry at or after it whose alpha is greater than 0.
  std::array<std::size_t, entries> next_visible_{};
  double table_error_;
};

}  // namespace triptych::reference
