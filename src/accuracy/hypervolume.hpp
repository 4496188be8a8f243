#pragma once
// One number for a front of run time against error. It is used to compare devices in one scene.

#include <cstddef>
#include <optional>
#include <span>

#include "accuracy/accuracy.hpp"

namespace triptych::accuracy {

// The corner of the area. Its coordinates do not depend on the measurements, because otherwise the
// area of a front would change with the other fronts:
//   - time: one second, which is too long for any interactive frame; an error that is not reached
//     counts as one that takes as long;
//   - error: the scene's own, that of an image in which nothing was drawn (0 in every channel),
//     which takes no time.
inline constexpr double reference_time_ns = 1e9;
// Smaller errors cannot be distinguished from the rounding of a float image. An error of 0 would
// make the area infinite.
inline constexpr double least_told_error = 0x1.0p-24;

// The area between the front and the corner, in ln time and ln error:
//   ∫ max(0, ln(reference time / t(e))) d ln e
// from the smallest distinguishable error to the reference error, where t(e) is the smallest time
// in which the error e is kept. `front` is the result of pareto_front. Points beyond the corner add
// nothing, and an empty front has area 0.
[[nodiscard]] double hypervolume(std::span<const AccuracyCase> cases,
                                 std::span<const std::size_t> front, double reference_error);

// The area of a front, and the largest width that any front with its errors can have.
struct FrontArea {
  double area = 0;
  double width = 0;  // ln(reference error / smallest error of the front)
};
// nullopt if nothing was timed, or if no error on the front is smaller than the reference error.
[[nodiscard]] std::optional<FrontArea> front_area(std::span<const AccuracyCase> cases,
                                                  std::span<const std::size_t> front,
                                                  double reference_error);

// The factor by which every time of `best` would have to grow for its area to be at most that of
// `other`. Times multiplied by c reduce an area by ln c · width, which is exact as long as none
// passes the corner.
[[nodiscard]] double equal_slowdown(const FrontArea& best, const FrontArea& other);

}  // namespace triptych::accuracy
