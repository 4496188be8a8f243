#pragma once
// One step of quadrature=preintegrated: the emission–absorption integral for a value that changes
// linearly from the step's front to its back, through the piecewise linear transfer function.

#include <array>
#include <cstddef>
#include <vector>

#include "reference/field.hpp"
#include "reference/opacity.hpp"
#include "reference/preintegration_bound.hpp"
#include "reference/table.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {

struct Segment {
  TableLookup lookup;  // the colour is the light divided by the opacity; the alphas are not used
  StepOpacity opacity;
};

// The step is integrated in double precision to about 1e-10. It is cut at the entries of the table
// and halved where the integrand is steep; each part is integrated by the four-point Gauss rule.
// PreintegrationBound derives the error bound.
class Preintegration {
 public:
  Preintegration(const Table& table, const ErrorModel& model);

  // Returns whether every value that a device may find is completely transparent. Here and below,
  // `front` and `back` are normalised values, and `length` is in voxel lengths.
  [[nodiscard]] bool transparent(const Bounded& front, const Bounded& back) const;
  [[nodiscard]] Segment operator()(const Bounded& front, const Bounded& back,
                                   const StepLength& length) const;

 private:
  using Rgba = std::array<double, 4>;
  struct Light {
    std::array<double, 3> colour{};  // premultiplied
    double depth = 0;
  };
  [[nodiscard]] Rgba at(double position) const;
  [[nodiscard]] std::vector<PathPiece> cut(double from, double to, double length) const;
  static void add(const PathPiece& piece, int level, Light& light);

  const Table& table_;
  const ErrorModel& model_;
};

}  // namespace triptych::reference
