#pragma once
// One number for a front of run time against error, by which devices are compared in one scene.

#include <cstddef>
#include <optional>
#include <span>

#include "accuracy/accuracy.hpp"

namespace triptych::accuracy {

// The corner of the area. Neither coordinate is taken from what was measured, or the area of a
// front would change with the others beside it:
//   time: one second, beyond which nobody waits for a frame; an error that is not reached counts as
//     one that takes as long;
//   error: the scene's own, of the picture in which nothing was drawn (0 in every channel), which
//     takes no time at all.
inline constexpr double reference_time_ns = 1e9;
// An error below it is not told from the rounding of a picture of floats; one of 0 would make the
// area infinite.
inline constexpr double least_told_error = 0x1.0p-24;

// The area between the front and the corner, in ln time and ln error:
//   ∫ max(0, ln(reference time / t(e))) d ln e from the least told error to the reference error,
// where t(e) is the least time in which the error e is kept. `front` as pareto_front gives it. What
// lies beyond the corner adds nothing; 0 for an empty front.
[[nodiscard]] double hypervolume(std::span<const AccuracyCase> cases,
                                 std::span<const std::size_t> front, double reference_error);

// A front's area and the widest that any other may have of the errors it reaches.
struct FrontArea {
  double area = 0;
  double width = 0;  // ln of the reference error over the front's least
};
// nullopt where nothing was timed or no error on the front is less than the reference's.
[[nodiscard]] std::optional<FrontArea> front_area(std::span<const AccuracyCase> cases,
                                                  std::span<const std::size_t> front,
                                                  double reference_error);

// By which factor every time of `best` would have to be longer for its area to be no more than
// `other`: times c takes ln c · width from an area, exactly as long as none passes the corner.
[[nodiscard]] double equal_slowdown(const FrontArea& best, const FrontArea& other);

}  // namespace triptych::accuracy
