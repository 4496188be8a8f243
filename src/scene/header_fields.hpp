#pragma once
// Helpers for readers of volume headers: axis directions and their anatomical names.

#include <array>
#include <string>
#include <string_view>

namespace triptych::scene {

using Vector3 = std::array<double, 3>;

[[nodiscard]] double dot_product(const Vector3& a, const Vector3& b);
[[nodiscard]] double length_of(const Vector3& a);

// Returns the names of two axes that are not perpendicular, such as "axes 0 and 1". Axes count as
// perpendicular if the cosine of the angle between them is at most 0.001. Returns an empty string
// if all axes are perpendicular.
[[nodiscard]] std::string sheared_axes(const std::array<Vector3, 3>& axes);

// Returns the main directions of the axes as letters, for example "RAS" if the axes point to the
// right, anterior and superior. `positive` is the coordinate system in which the vectors are given,
// named by the positive directions of its axes: "RAS" or "LPS".
[[nodiscard]] std::string anatomical_letters(const std::array<Vector3, 3>& axes,
                                             std::string_view positive);

}  // namespace triptych::scene
