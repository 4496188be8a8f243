#include "reference/field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace triptych::reference {

template <typename Stored>
Field<Stored>::Field(const scene::VoxelGrid& grid, const ErrorModel& model)
    : data_(grid.data.data()),
      size_(grid.size),
      scale_(grid.scale),
      offset_(grid.offset),
      value_error_(model.value_error),
      voxel_rounding_(model.voxel_rounding),
      filter_weight_error_(model.filter_weight_error),
      exact_(model.position_error_voxels == 0 && model.filter_weight_error == 0) {
  if (exact_) return;
  double lo = stored(0);
  double hi = lo;
  const auto count = static_cast<std::ptrdiff_t>(grid.voxel_count());
  for (std::ptrdiff_t i = 1; i < count; ++i) {
    const double value = stored(i);
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
  range_ = hi - lo;
}

template <typename Stored>
double Field<Stored>::stored(std::ptrdiff_t index) const {
  Stored value;
  std::memcpy(&value, data_ + index * static_cast<std::ptrdiff_t>(sizeof(Stored)), sizeof(Stored));
  return static_cast<double>(value);
}

template <typename Stored>
typename Field<Stored>::Place Field<Stored>::place(double p, int axis) const {
  // More than half a voxel outside the volume, the field is constant, so positions are clamped.
  const double end = size_[static_cast<std::size_t>(axis)];
  const double q = std::min(std::max(p - 0.5, -1.0), end);
  const int base = static_cast<int>(q + 1.0) - 1;  // ⌊q⌋ for q ≥ −1
  return {base, q - static_cast<double>(base)};
}

template <typename Stored>
typename Field<Stored>::Corners Field<Stored>::corners(const std::array<int, 3>& base) const {
  std::array<std::ptrdiff_t, 3> a;
  std::array<std::ptrdiff_t, 3> b;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    a[axis] = std::clamp(base[axis], 0, size_[axis] - 1);
    b[axis] = std::clamp(base[axis] + 1, 0, size_[axis] - 1);
  }
  const std::ptrdiff_t nx = size_[0];
  const std::ptrdiff_t ny = size_[1];
  const std::ptrdiff_t row00 = nx * (a[1] + ny * a[2]);
  const std::ptrdiff_t row10 = nx * (b[1] + ny * a[2]);
  const std::ptrdiff_t row01 = nx * (a[1] + ny * b[2]);
  const std::ptrdiff_t row11 = nx * (b[1] + ny * b[2]);
  return {stored(row00 + a[0]), stored(row00 + b[0]), stored(row10 + a[0]), stored(row10 + b[0]),
          stored(row01 + a[0]), stored(row01 + b[0]), stored(row11 + a[0]), stored(row11 + b[0])};
}

namespace {

double interpolate(const std::array<double, 8>& v, double fx, double fy, double fz) {
  const double x00 = v[0] + fx * (v[1] - v[0]);
  const double x10 = v[2] + fx * (v[3] - v[2]);
  const double x01 = v[4] + fx * (v[5] - v[4]);
  const double x11 = v[6] + fx * (v[7] - v[6]);
  const double y0 = x00 + fy * (x10 - x00);
  const double y1 = x01 + fy * (x11 - x01);
  return y0 + fz * (y1 - y0);
}

double least(double a, double b, double c, double d) {
  return std::min(std::min(a, b), std::min(c, d));
}

double largest(double a, double b, double c, double d) {
  return std::max(std::max(a, b), std::max(c, d));
}

}  // namespace

template <typename Stored>
Field<Stored>::Slopes::Slopes(const Corners& v)
    : lo(least(v[1] - v[0], v[3] - v[2], v[5] - v[4], v[7] - v[6]),
         least(v[2] - v[0], v[3] - v[1], v[6] - v[4], v[7] - v[5]),
         least(v[4] - v[0], v[5] - v[1], v[6] - v[2], v[7] - v[3])),
      hi(largest(v[1] - v[0], v[3] - v[2], v[5] - v[4], v[7] - v[6]),
         largest(v[2] - v[0], v[3] - v[1], v[6] - v[4], v[7] - v[5]),
         largest(v[4] - v[0], v[5] - v[1], v[6] - v[2], v[7] - v[3])),
      spread(std::max(largest(v[0], v[1], v[2], v[3]), largest(v[4], v[5], v[6], v[7])) -
             std::min(least(v[0], v[1], v[2], v[3]), least(v[4], v[5], v[6], v[7]))) {}

template <typename Stored>
void Field<Stored>::Slopes::widen(const Slopes& other) {
  lo = glm::min(lo, other.lo);
  hi = glm::max(hi, other.hi);
  spread = std::max(spread, other.spread);
}

template <typename Stored>
glm::dvec3 Field<Stored>::Slopes::steepest() const {
  return glm::max(glm::abs(lo), glm::abs(hi));
}

// Returns the extremes of the slopes over every cell that may contain the position if it has an
// error of up to e. e must be below half a voxel.
template <typename Stored>
typename Field<Stored>::Slopes Field<Stored>::slopes_around(const std::array<Place, 3>& places,
                                                            const glm::dvec3& e) const {
  std::array<int, 3> first;
  std::array<int, 3> last;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double error = e[static_cast<int>(axis)];
    first[axis] = places[axis].base - (places[axis].f <= error ? 1 : 0);
    last[axis] = places[axis].base + (places[axis].f >= 1.0 - error ? 1 : 0);
  }
  Slopes slopes(corners(first));
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) slopes.widen(Slopes(corners({i, j, k})));
    }
  }
  return slopes;
}

template <typename Stored>
double Field<Stored>::at(const glm::dvec3& p) const {
  const Place x = place(p.x, 0);
  const Place y = place(p.y, 1);
  const Place z = place(p.z, 2);
  return interpolate(corners({x.base, y.base, z.base}), x.f, y.f, z.f) * scale_ + offset_;
}

template <typename Stored>
typename Field<Stored>::Read Field<Stored>::read(const glm::dvec3& p, const glm::dvec3& e) const {
  const std::array<Place, 3> places{place(p.x, 0), place(p.y, 1), place(p.z, 2)};
  const Corners v = corners({places[0].base, places[1].base, places[2].base});
  Read result{interpolate(v, places[0].f, places[1].f, places[2].f),
              e.x < 0.5 && e.y < 0.5 && e.z < 0.5, Slopes(v)};
  const auto interior = [&](std::size_t axis) {
    const double margin = e[static_cast<int>(axis)];
    return places[axis].f > margin && places[axis].f < 1.0 - margin;
  };
  if (result.local && !(interior(0) && interior(1) && interior(2))) {
    result.slopes = slopes_around(places, e);
  }
  return result;
}

// Returns the error in stored units. It cannot exceed the range of the voxels, because an
// interpolated value stays within this range for any weights.
template <typename Stored>
double Field<Stored>::error_of(const Read& read, const glm::dvec3& e) const {
  if (!read.local) return range_;
  return std::min(glm::dot(read.slopes.steepest(), e) + filter_weight_error_ * read.slopes.spread,
                  range_);
}

template <typename Stored>
Bounded Field<Stored>::at(const glm::dvec3& p, const glm::dvec3& e) const {
  if (exact_) {
    const double value = at(p);
    return {value, value_error_ + voxel_rounding_ * std::abs(value)};
  }
  const Read sample = read(p, e);
  const double value = sample.stored * scale_ + offset_;
  const double error = error_of(sample, e) * std::abs(scale_);
  return {value, error + voxel_rounding_ * (std::abs(value) + error) + value_error_};
}

template <typename Stored>
Bounded Field<Stored>::difference(const glm::dvec3& a, const glm::dvec3& b,
                                  const glm::dvec3& shared_error, double own_error) const {
  if (exact_) {
    const double above = at(a);
    const double below = at(b);
    return {above - below,
            2.0 * value_error_ + voxel_rounding_ * (std::abs(above) + std::abs(below))};
  }
  const glm::dvec3 e = shared_error + own_error;
  const Read above = read(a, e);
  const Read below = read(b, e);
  const double separate_error = error_of(above, e) + error_of(below, e);
  const double rounded = std::abs(above.stored * scale_ + offset_) +
                         std::abs(below.stored * scale_ + offset_) +
                         separate_error * std::abs(scale_);
  double error = separate_error;
  if (above.local && below.local) {
    const glm::dvec3 bend = glm::max(above.slopes.hi - below.slopes.lo,  //
                                     below.slopes.hi - above.slopes.lo);
    const glm::dvec3 steepest = above.slopes.steepest() + below.slopes.steepest();
    const double joint_error = glm::dot(bend, shared_error) +
                               own_error * (steepest.x + steepest.y + steepest.z) +
                               filter_weight_error_ * (above.slopes.spread + below.slopes.spread);
    error = std::min(error, joint_error);
  }
  return {(above.stored - below.stored) * scale_,
          error * std::abs(scale_) + voxel_rounding_ * rounded + 2.0 * value_error_};
}

template class Field<std::uint8_t>;
template class Field<std::uint16_t>;
template class Field<float>;
template class Field<scene::Half>;

}  // namespace triptych::reference
