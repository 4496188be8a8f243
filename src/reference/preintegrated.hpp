#pragma once
// One step of quadrature preintegrated: the emission–absorption integral where the value runs
// straight from the step's front to its back, through the piecewise linear transfer function.

#include <array>
#include <cstddef>
#include <vector>

#include "reference/field.hpp"
#include "reference/opacity.hpp"
#include "reference/table.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {

struct Segment {
  Looked looked;  // colour: light over opacity; alpha is not used
  StepOpacity opacity;
};

// The nominal step is integrated in double to about 1e-10: cut at the entries of the table, halved
// where the integrand is steep, Gauss's rule with four points on each part. The bound is that of a
// device that tabulates the paths between entries and cuts a step at the first and the last entry
// it passes:
//
// Values. A device's front and back lie within e (table entries) of the true ones, so its whole
// path
//   does, and opacity and colour along it are off by at most e times the steepest slope of the
//   cells in reach, plus table_error. That makes the optical depth lie between those of the opacity
//   lowered and raised; ρ is its largest change.
// Weights. With C the step's colour, ∫(c − C)·τE = 0, and by the identity of composite.hpp a change
//   of τ by ρ in all changes the light by that of the opacity times C and at most 2Rρ, R the range
//   of the colour along the path; it never exceeds R times the opacity.
// Cut-off. e^(−Dy) = Σ (−1)ⁿ·(2n + 1)·e^(−D/2)·i_n(D/2)·Pn(y), and what is left behind n = 2 has
//   a norm of at most D³/(120·√7): e^(−z)·i₃(z) ≤ z³/105, and the terms behind it fall faster than
//   e^(−z) lets this one grow. Of the colour at most R/2 is left, so the light errs by at most
//   R·D⁴/635 (Cauchy and Schwarz), and never by more than R times the opacity.
// Cells. Within the first and the last cell extinction is taken as straight. It bends by at most
//   Δ²/8(1 − α)², Δ the opacity's rise over the cell; by the same argument the light errs by at
//   most twice that times the length and the colour's range in a cell. The mean of the logarithm is
//   cut off behind r¹², r = Δ/2(1 − α): r¹⁴/(210·(1 − r²)) per voxel, at most 0.038.
// Rounding. Of opacity the model's opacity_error; of colour eight of compositing_error for the sum
//   of three coefficients and three pieces.
class Preintegration {
 public:
  Preintegration(const Table& table, const ErrorModel& model);

  // `front` and `back` are normalised values, `length` in voxel lengths.
  // Whether no value that a device may find has any opacity.
  [[nodiscard]] bool transparent(const Bounded& front, const Bounded& back) const;
  [[nodiscard]] Segment operator()(const Bounded& front, const Bounded& back,
                                   const StepLength& length) const;

 private:
  using Rgba = std::array<double, 4>;
  // Straight in opacity and colour over a length.
  struct Piece {
    Rgba a{};
    Rgba b{};
    double length = 0;
  };
  struct Light {
    std::array<double, 3> colour{};  // premultiplied
    double depth = 0;
  };
  // The largest slopes per entry of the cells in reach, and the highest opacity there.
  struct Reach {
    Rgba slope{};
    double most_alpha = 0;
  };

  [[nodiscard]] Rgba at(double position) const;
  [[nodiscard]] std::vector<Piece> cut(double from, double to, double length) const;
  [[nodiscard]] Reach reach(double lo, double hi) const;
  static void add(const Piece& piece, int level, Light& light);

  const Table& table_;
  const ErrorModel& model_;
};

}  // namespace triptych::reference
