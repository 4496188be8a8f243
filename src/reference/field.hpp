#pragma once
// The normalised field: trilinear between voxel centres, clamped to the edge.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "reference/volume.hpp"
#include "scene/half.hpp"
#include "scene/volume.hpp"

namespace triptych::reference {

// A value and the most by which the error model lets a device's value differ from it.
struct Bounded {
  double value = 0;
  double error = 0;
};

// Reads the grid in place; Stored is what one voxel of it is: std::uint8_t, std::uint16_t, float or
// scene::Half. Interpolates stored values, which are exact, and maps the result. Positions in
// voxels.
template <typename Stored>
class Field {
 public:
  // The grid must outlive the field. Reads every voxel once where the model has a position error.
  Field(const scene::VoxelGrid& grid, const ErrorModel& model);

  [[nodiscard]] double at(const glm::dvec3& p) const;

  // The error is Σ over axes of (largest difference of neighbours in any cell that a device may
  // read instead) × position error, for a trilinear field is Lipschitz with just these constants;
  // plus filter_weight_error × spread of the eight voxels, plus value_error. Voxels that are each
  // off by a share of themselves move what weights of at least 0 make of them by at most that share
  // of it: plus voxel_rounding × (value + all that is above but value_error).
  [[nodiscard]] Bounded at(const glm::dvec3& p, const glm::dvec3& position_error) const;

  // at(a) − at(b) for two places that are displaced together by up to `shared_error` and each on
  // its own by up to `own_error` per axis: together they change it only by how much the slopes
  // differ.
  [[nodiscard]] Bounded difference(const glm::dvec3& a, const glm::dvec3& b,
                                   const glm::dvec3& shared_error, double own_error) const;

 private:
  // Where p falls along one axis: between voxels base and base + 1 (before clamping), at fraction
  // f.
  struct Place {
    int base = 0;
    double f = 0;
  };
  using Corners = std::array<double, 8>;  // bit 0: x, bit 1: y, bit 2: z

  // How the field may change: extremes of the difference of two neighbours per axis, and the
  // largest of any two voxels of one cell.
  struct Slopes {
    glm::dvec3 lo;
    glm::dvec3 hi;
    double spread;
    explicit Slopes(const Corners& corners);
    void widen(const Slopes& other);
    [[nodiscard]] glm::dvec3 steepest() const;
  };

  // A stored value; its slopes are known where the place is, to better than half a voxel.
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
  bool exact_;        // places and weights have no error, so slopes play no part
};

extern template class Field<std::uint8_t>;
extern template class Field<std::uint16_t>;
extern template class Field<float>;
extern template class Field<scene::Half>;

}  // namespace triptych::reference
