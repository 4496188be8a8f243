#pragma once
// Headlight shading (scene::Shading) of one sample, with its error.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "reference/field.hpp"
#include "reference/ray.hpp"
#include "reference/table.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::reference {

// Returns |g·d|/max(|g|, floor) and its error, where g is the gradient at p and d the direction of
// the ray. Let cos be the exact value, cos' the value on a device, δ the largest error of g, and m
// the denominator. A device's denominator is at least m' = max(floor, |g| − δ), so that
//   |cos' − cos| ≤ |δ|/m' + |g·d|·|m − m'|/(m·m') ≤ (1 + cos)·|δ|/m'.
// The dot product, the square root, the division and the unit direction add at most eight roundings
// of a quantity that is at most 1. The six positions around p share the error of p; each of them
// also has the rounding error of a coordinate.
template <typename Stored>
[[nodiscard]] Bounded headlight_cosine(const Field<Stored>& field, const Ray& ray,
                                       const glm::dvec3& p, const glm::dvec3& gradient_scale,
                                       double floor, double rounding) {
  const glm::dvec3 magnitude = glm::abs(p) + 1.0;
  const double own_error = rounding * std::max({magnitude.x, magnitude.y, magnitude.z});
  glm::dvec3 gradient{0.0};
  glm::dvec3 error{0.0};
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 one{0.0};
    one[axis] = 1.0;
    const Bounded difference = field.difference(p + one, p - one, ray.position_error, own_error);
    gradient[axis] = 0.5 * gradient_scale[axis] * difference.value;
    error[axis] = 0.5 * gradient_scale[axis] * difference.error;
  }
  const double length = glm::length(gradient);
  const double change = glm::length(error);
  Bounded cosine;
  cosine.value = std::abs(glm::dot(gradient, ray.direction)) / std::max(length, floor);
  const double least = std::max(floor, length - change);
  if (change > 0.0) cosine.error = (1.0 + cosine.value) * change / least;
  cosine.error = std::min(cosine.error + 8.0 * rounding, 1.0);
  return cosine;
}

[[nodiscard]] inline double power(double base, int exponent) {
  double result = base;
  for (int n = 1; n < exponent; n *= 2) result *= result;
  return result;
}

// Replaces the looked-up colour by the shaded colour. `rounding` is the relative error of one
// operation. Each squaring doubles a relative error, so the highlight has `exponent` roundings.
// Adding the highlight to the colour contributes four more roundings.
inline void shade(TableLookup& lookup, const Bounded& cosine, const scene::Shading& shading,
                  double rounding) {
  const double cosine_hi = std::min(cosine.value + cosine.error, 1.0);
  const double cosine_lo = std::max(cosine.value - cosine.error, 0.0);
  const double highlight = power(cosine.value, shading.exponent);
  const double highest = power(cosine_hi, shading.exponent);
  const double highlight_error =
      std::max(highest - highlight, highlight - power(cosine_lo, shading.exponent)) +
      shading.exponent * rounding * highest;
  const double factor = shading.ambient + shading.diffuse * cosine.value;
  const double factor_hi = shading.ambient + shading.diffuse * cosine_hi;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double colour = lookup.colour[channel];
    lookup.colour[channel] = colour * factor + shading.specular * highlight;
    lookup.colour_error[channel] =
        lookup.colour_error[channel] * factor_hi + colour * shading.diffuse * cosine.error +
        shading.specular * highlight_error + 4.0 * rounding * lookup.colour[channel];
  }
}

}  // namespace triptych::reference
