#pragma once
// Summarises a Pareto front of run time against error as a single number, for comparing devices
// that draw the same scene.

#include <cstddef>
#include <optional>
#include <span>

#include "accuracy/accuracy.hpp"

namespace triptych::accuracy {

// hypervolume() computes the area between a front and this reference point. The coordinates of the
// point do not depend on the measurements; otherwise, the area of one front would change whenever
// another front changes:
//   - time: one second, which is too long for any interactive frame. An error that is not reached
//     counts as if it took one second.
//   - error: the error of an image in which nothing was drawn (0 in every channel), which takes no
//     time. It depends on the scene.
inline constexpr double reference_time_ns = 1e9;
// The smallest error that is taken into account. Smaller errors cannot be distinguished from the
// rounding of a float image, and an error of 0 would make the area infinite.
inline constexpr double least_reported_error = 0x1.0p-24;

// Returns the area between the front and the reference point, in ln time and ln error:
//   ∫ max(0, ln(reference time / t(e))) d ln e
// from the smallest distinguishable error to the reference error, where t(e) is the smallest time
// in which the error e is reached. `front` is the result of pareto_front. Points beyond the
// reference point add nothing, and an empty front has the area 0.
[[nodiscard]] double hypervolume(std::span<const AccuracyCase> cases,
                                 std::span<const std::size_t> front, double reference_error);

// The area of a front, and the width of the range of errors that it covers.
struct FrontArea {
  double area = 0;
  double width = 0;  // ln(reference error / smallest error of the front)
};
// Returns nullopt if nothing was timed, or if no error on the front is smaller than the reference
// error.
[[nodiscard]] std::optional<FrontArea> front_area(std::span<const AccuracyCase> cases,
                                                  std::span<const std::size_t> front,
                                                  double reference_error);

// Returns the factor by which every time of `best` must grow to reduce its area to that of `other`.
// Multiplying all times by c reduces an area by ln c · width. This is exact as long as no time
// exceeds the reference time.
[[nodiscard]] double equal_slowdown(const FrontArea& best, const FrontArea& other);

}  // namespace triptych::accuracy
