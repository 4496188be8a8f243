#pragma once
// How far a device may be from one step of quadrature preintegrated.

#include <array>
#include <cstddef>

#include "reference/opacity.hpp"
#include "reference/table.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {

// Straight in opacity and colour over a length.
struct PathPiece {
  std::array<double, 4> a{};
  std::array<double, 4> b{};
  double length = 0;
  double middle = 0;  // its place among the table's entries
};

// The path of one step: positions among the table's entries, and how far a device's ends may lie
// from them.
struct StepPath {
  double from = 0;
  double to = 0;
  double error = 0;
  StepLength length;
  std::size_t pieces = 0;
};

// Of a device that tabulates the paths between entries, cuts a step at the first and the last entry
// that it passes, and takes the whole cells between them front to back, in chunks that are no
// deeper than half a power of two or are one cell; once less than 2⁻²⁰ of the light is left, as
// one. All light below is premultiplied, R is the range of the colour along the path, A the step's
// opacity, T the transmittance from the step's front.
//
// Values. A device's front and back lie within e of the true ones, so its whole path does, and
//   opacity and colour in every piece are off by at most e times the steepest slope of the cells in
//   reach of it, plus table_error. The optical depth lies between those of the opacity lowered and
//   raised.
// Weights. With C the step's colour, ∫(c − C)·τT = 0, and by the identity of composite.hpp a change
//   of extinction by δ changes the light by that of the opacity times C and at most
//   2R·∫T'δ, R·A in all. Of a piece ∫T'δ is at most T' at its front times the change of its depth,
//   and times the largest relative change of extinction times the piece's opacity.
// Chunks. e^(−Dy) = Σ (−1)ⁿ·(2n + 1)·e^(−D/2)·i_n(D/2)·Pn(y), and what is left behind n = 2 has a
//   norm of at most D³/(120·√7): e^(−z)·i₃(z) ≤ z³/105, and the terms behind it fall faster than
//   e^(−z) lets this one grow. Of the colour at most R/2 is left, so the light of a chunk of depth
//   D errs by at most R·D⁴/635 (Cauchy and Schwarz). With D ≤ ln 2/2 that is 7.8e-5 of R times the
//   chunk's opacity, and all chunks together err by as much of A.
// Deep cells. Along one cell the colour runs straight in the place, and the place, as a function of
//   the share of the depth passed, leaves its first three coefficients by at most t²/4, where
//   extinction rises or falls by t around its mean (a test looks at all of them). So the light of a
//   cell of colour range R errs by at most R·A·t²/4 however deep it is.
// Ends. Within the first and the last cell extinction is taken as straight. It bends by at most
//   Δ²/8(1 − α)², Δ the opacity's rise over the cell, which counts as under weights. The mean of
//   the logarithm is cut off behind r¹², r = Δ/2(1 − α): r¹⁴/(210·(1 − r²)) per voxel, at most
//   0.038.
// A device's cells are longer or shorter than the true ones by a factor of at most
// 1/(1 − 2e/|to − from|). Where that is more than 2, the path hardly leaves a cell: its R bounds
// it. Rounding. Of opacity the model's opacity_error, and one compositing_error for each piece
// beyond
//   three; of colour eight of compositing_error for the sum of three coefficients, and two for each
//   piece.
class PreintegrationBound {
 public:
  PreintegrationBound(const Table& table, const ErrorModel& model, const StepPath& path);

  // The pieces of the path in order, lengths as shares of the step, and each one's true depth.
  void add(const PathPiece& piece, double depth);

  // Behind the last piece.
  [[nodiscard]] StepOpacity opacity(double nominal) const;
  // Of the straight colour.
  [[nodiscard]] double colour_error(std::size_t channel, const StepOpacity& opacity) const;

 private:
  using Rgba = std::array<double, 4>;
  // Of the cells in reach of an interval: the largest slopes per entry, the lowest and the highest
  // opacity, and by how much extinction rises or falls around its mean.
  struct Reach {
    Rgba slope{};
    double least_alpha = 1;
    double most_alpha = 0;
    double tilt = 0;
    [[nodiscard]] double bend() const;  // of extinction, from a straight line
    [[nodiscard]] double tail() const;  // of the logarithm's series
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
  double span_;      // entries
  double widening_;  // of a device's cells; 0 where the path hardly leaves one
  Reach around_;
  double alpha_error_;
  double least_ = 0;         // of the depth …
  double most_ = 0;          // … so far
  double depth_ = 0;         // the true one
  double tails_ = 0;         // of the series, per voxel
  double front_ = 1;         // the most that is left of the light …
  double front_before_ = 1;  // … and was in front of the piece before
  std::size_t added_ = 0;
  double weights_ = 0;  // ∫T'δ
  Rgba values_{};       // ∫T'τ' times the errors of the values
  Rgba lowest_{};       // of the colours along the path
  Rgba highest_{};
  Rgba deep_cells_{};
  Rgba ends_{};
};

}  // namespace triptych::reference
