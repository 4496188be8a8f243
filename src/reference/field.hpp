#pragma once
// The normalised scalar field of a volume, interpolated trilinearly between voxel centres and
// clamped to the edge.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "reference/volume.hpp"
#include "scene/half.hpp"
#include "scene/volume.hpp"

namespace triptych::reference {

// A value, and the largest deviation from this value that the error model permits on a device.
struct Bounded {
  double value = 0;
  double error = 0;
};

// The field of a grid, which is read in place. Stored is the type of a voxel: std::uint8_t,
// std::uint16_t, float or scene::Half. The stored values, which are exact, are interpolated, and
// the result is then mapped to the normalised range. Positions are in voxels. A cell is the cube
// between eight neighbouring voxel centres.
template <typename Stored>
class Field {
 public:
  // The grid must outlive the field. The constructor reads every voxel once, unless the model has
  // neither a position error nor an error of the interpolation weights.
  Field(const scene::VoxelGrid& grid, const ErrorModel& model);

  [[nodiscard]] double at(const glm::dvec3& p) const;

  // Returns the value at p and its error, which is the sum of these terms:
  //
  //   - For each axis, the position error times the largest difference between neighbouring voxels
  //     in any cell that contains a point within the position error of p. (A trilinear field is
  //     Lipschitz continuous.)
  //   - filter_weight_error times the spread of the eight voxels.
  //   - value_error.
  //   - voxel_rounding times the sum of the value and all terms above except value_error. The
  //     reason is that a relative error of the voxels changes their weighted mean, with weights ≥
  //     0, by at most the same relative error.
  [[nodiscard]] Bounded at(const glm::dvec3& p, const glm::dvec3& position_error) const;

  // Returns at(a) − at(b) and its error, for two positions that are displaced together by up to
  // `shared_error` per axis, and each individually by up to `own_error`. A common displacement
  // changes the difference only by as much as the slopes at a and b differ.
  [[nodiscard]] Bounded difference(const glm::dvec3& a, const glm::dvec3& b,
                                   const glm::dvec3& shared_error, double own_error) const;

 private:
  // A position along one axis: it is between the voxels base and base + 1 (before clamping), at the
  // fraction f.
  struct Place {
    int base = 0;
    double f = 0;
  };
  using Corners = std::array<double, 8>;  // bit 0: x, bit 1: y, bit 2: z

  // Bounds on how fast the field changes in a cell: for each axis, the smallest and the largest
  // difference between two neighbouring voxels, and the largest difference between any two voxels
  // of the cell.
  struct Slopes {
    glm::dvec3 lo;
    glm::dvec3 hi;
    double spread;
    explicit Slopes(const Corners& corners);
    void widen(const Slopes& other);
    [[nodiscard]] glm::dvec3 steepest() const;
  };

  // The interpolated stored value at a position. If the position error is below half a voxel,
  // `local` is true, and `slopes` cover every cell that a device may read. Otherwise, `slopes` must
  // not be used.
  struct Read {
    double stored;
    bool local;
    Slopes slopes;
  };

  [[nodiscard]] Place place(double p, int axis) const;
  [[nodiscard]] double stored(std::ptrdiff_t index) const;
  [[nodiscard]] Corners corners(const std::array<int, 3>& base) const;
  [[nodiscard]] Read read(const glm::dvec3& p, const glm::dvec3& position_error) const;
  [[nodiscard]] double error_of(const Read& read, const glm::dvec3& position_error) const;
  [[nodiscard]] Slopes slopes_around(const std::array<Place, 3>& places,
                                     const glm::dvec3& position_error) const;

  const std::byte* data_;
  std::array<int, 3> size_;
  double scale_;
  double offset_;
  double value_error_;
  double voxel_rounding_;
  double filter_weight_error_;
  double range_ = 0;  // largest minus smallest stored value
  bool exact_;        // whether positions and weights are exact, so that slopes are not needed
};

extern template class Field<std::uint8_t>;
extern template class Field<std::uint16_t>;
extern template class Field<float>;
extern template class Field<scene::Half>;

}  // namespace triptych::reference
