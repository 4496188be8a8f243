#pragma once
// Bounds the error that a device may have in one step of quadrature=preintegrated.

#include <array>
#include <cstddef>

#include "reference/opacity.hpp"
#include "reference/table.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {

// A piece along which opacity and colour are linear. a and b are the colour and the opacity at its
// front and at its back.
struct PathPiece {
  std::array<double, 4> a{};
  std::array<double, 4> b{};
  double length = 0;
  double middle = 0;  // position of its middle in the table
};

// The path of one step: the positions of its ends in the table, and the largest error of these
// positions on a device.
struct StepPath {
  double from = 0;
  double to = 0;
  double error = 0;
  StepLength length;
  std::size_t pieces = 0;
};

// The bound applies to a device that has a table of the paths between all pairs of entries
// (technique/volume/preintegration.hpp). A cell is the interval between two neighbouring entries.
// The device cuts a step at the first and the last entry that the step passes. It processes the
// whole cells between these entries from front to back, one by one or in chunks whose optical depth
// is at most (ln 2)/2; once less than 2⁻²⁰ of the light is left, all remaining cells form one
// chunk.
//
// All light below is premultiplied. Along the path, τ is the extinction, c the colour, R the range
// of c, and T the transmittance from the front of the step. A is the opacity of the step, and C its
// colour before premultiplication. A prime marks a device's quantities.
//
//   - Values. A device's values at front and back, as positions in the table, are within e
//     (StepPath::error) of the exact positions, and so are all values on its path. Opacity and
//     colour in every piece therefore have an error of at most e times the steepest slope of the
//     cells within this distance, plus table_error. The optical depth is between the depths for the
//     lowered and the raised opacity.
//   - Weights. C is the mean of c with the weights τT, so ∫(c − C)·τT = 0. By the identity in
//     composite.hpp, a change of the extinction by δ changes the light by the change of the opacity
//     times C, and in addition by at most the smaller of 2R·∫T'δ and R·A. For a piece, ∫T'δ is at
//     most T' at its front times the smaller of two numbers: the change of the piece's depth, and
//     its opacity times the largest relative change of the extinction.
//   - Chunks. Let D be the optical depth of a chunk, y the share of D that the light has passed,
//     i_n the modified spherical Bessel functions, and Pn the Legendre polynomials on [0, 1]. Then
//     e^(−Dy) = Σ (−1)ⁿ·(2n + 1)·e^(−D/2)·i_n(D/2)·Pn(y). The table contains the colour's first
//     three coefficients, so a device loses the terms after n = 2. Their sum has an L² norm of at
//     most D³/(120·√7). This holds because e^(−z)·i₃(z) ≤ z³/105 for z = D/2, and because the
//     difference between the two sides is larger than the contribution of all further terms. After
//     subtracting the middle of its range, the colour is at most R/2, so the light of the chunk has
//     an error of at most R·D⁴/635 (Cauchy–Schwarz). With D ≤ (ln 2)/2 this is 7.8e-5·R times the
//     chunk's opacity, so all chunks together have an error of at most 7.8e-5·R·A.
//   - Deep cells. A single cell may be deeper than (ln 2)/2. Along one cell, the colour is linear
//     in the position. Consider the position as a function of the share of the depth that the light
//     has passed. This function differs from the polynomial with its first three Legendre
//     coefficients by at most t²/4, where t is the relative change of the extinction around its
//     mean (a test checks all cases). The light of a cell with colour range R therefore has an
//     error of at most R·A·t²/4 for any depth.
//   - Ends. Within the first and the last cell, the extinction is assumed to be linear. It deviates
//     from a straight line by at most Δ²/(8·(1 − α)²), where α is the largest opacity in the cell
//     and Δ the rise of the opacity over the cell. This deviation is treated like a change of
//     weights. A device computes the mean of ln(1 − α) by a series, which it truncates after r¹²
//     with r = Δ/(2·(1 − α)). That loses r¹⁴/(210·(1 − r²)) of the optical depth per voxel length,
//     at most 0.038.
//   - Lengths. A device's cells are longer or shorter than the exact cells by a factor of at most
//     1/(1 − 2e/|to − from|). If this factor is more than 2, the path hardly leaves a cell, and the
//     colour range R of the path bounds the error.
//   - Rounding. The opacity has the model's opacity_error, and one compositing_error for each piece
//     beyond three. The colour has eight compositing_errors for the sum of three coefficients, and
//     two for each piece.
class PreintegrationBound {
 public:
  PreintegrationBound(const Table& table, const ErrorModel& model, const StepPath& path);

  // Adds the next piece of the path. Its length is a share of the step. `depth` is its exact
  // optical depth.
  void add(const PathPiece& piece, double depth);

  // Returns the opacity of the step. Call this function after the last piece has been added.
  [[nodiscard]] StepOpacity opacity(double nominal) const;
  // Returns the error of the colour before premultiplication. Call this function after the last
  // piece has been added.
  [[nodiscard]] double colour_error(std::size_t channel, const StepOpacity& opacity) const;

 private:
  using Rgba = std::array<double, 4>;
  // Properties of the cells that an interval reaches: the largest slopes per entry, the lowest and
  // highest opacity, and the largest relative change of extinction around its mean.
  struct Reach {
    Rgba slope{};
    double least_alpha = 1;
    double most_alpha = 0;
    double tilt = 0;
    [[nodiscard]] double bend() const;  // deviation of extinction from a straight line
    [[nodiscard]] double tail() const;  // truncation error of the logarithm's series
  };

  [[nodiscard]] Rgba at(double position) const;
  [[nodiscard]] Reach reach(double lo, double hi) const;
  [[nodiscard]] Rgba slopes_near(const PathPiece& piece) const;
  [[nodiscard]] double relative_change(const PathPiece& piece, double alpha_error) const;
  [[nodiscard]] double extinction_around(double position) const;
  [[nodiscard]] double most_depth() const;
  [[nodiscard]] bool deep_slivers() const;
  void add_weights(const PathPiece& piece, double depth, double tail);
  void add_deep_cell(const PathPiece& piece, double tilt);
  void add_end(const PathPiece& piece, double position, const Reach& end);

  const Table& table_;
  const ErrorModel& model_;
  StepPath path_;
  double span_;  // length of the path, in table entries
  // The largest factor by which a device's cells may be longer than the exact cells; 0 if the path
  // hardly leaves a cell.
  double widening_;
  Reach around_;
  double alpha_error_;
  double least_ = 0;         // smallest optical depth of the pieces so far on any device
  double most_ = 0;          // largest optical depth of the pieces so far on any device
  double depth_ = 0;         // exact optical depth of the pieces so far
  double tails_ = 0;         // truncation errors of the series, per voxel length
  double front_ = 1;         // largest share of the light that is left behind the pieces so far
  double front_before_ = 1;  // front_ before the most recent piece
  std::size_t added_ = 0;
  // The parts of the error that the derivation above calls "weights", which is ∫T'δ, and "values",
  // which is ∫T'τ' times the errors of the colours.
  double weights_ = 0;
  Rgba values_{};
  Rgba lowest_{};  // lowest colours along the path
  Rgba highest_{};
  Rgba deep_cells_{};
  Rgba ends_{};
};

}  // namespace triptych::reference
