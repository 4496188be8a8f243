#pragma once
// Shared by the headers of volumes: directions of axes, and names of anatomical directions.

#include <array>
#include <string>
#include <string_view>

namespace triptych::scene {

using Vector3 = std::array<double, 3>;

[[nodiscard]] double dot_product(const Vector3& a, const Vector3& b);
[[nodiscard]] double length_of(const Vector3& a);

// The two axes that are not perpendicular, such as "axes 0 and 1"; empty if all are, to a
// thousandth.
[[nodiscard]] std::string sheared_axes(const std::array<Vector3, 3>& axes);

// The main directions of the axes: "RAS" for axes along +x, +y and +z of a space whose axes point
// to R, A and S. `positive` names the space's own directions, "RAS" or "LPS".
[[nodiscard]] std::string anatomical_letters(const std::array<Vector3, 3>& axes,
                                             std::string_view positive);

}  // namespace triptych::scene
