#include "scene/mandelbulb.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "scene/exact_math.hpp"

namespace triptych::scene {
namespace {

struct Complex {
  double re = 1;
  double im = 0;
};

Complex squared(Complex z) {
  return {z.re * z.re - z.im * z.im, 2 * z.re * z.im};
}
Complex eighth_power(Complex z) {
  return squared(squared(squared(z)));
}

// Returns z⁸ as defined by White and Nylander: for z = r·(sin θ·cos φ, sin θ·sin φ, cos θ), the
// result has the radius r⁸ and the angles 8θ and 8φ. The multiples of the angles are computed as
// complex powers, which need no trigonometric functions.
glm::dvec3 eighth_power(glm::dvec3 z) {
  const double rho = std::sqrt(z.x * z.x + z.y * z.y);
  const Complex theta = eighth_power(Complex{z.z, rho});  // r⁸·(cos 8θ, sin 8θ)
  const Complex phi = rho > 0 ? eighth_power(Complex{z.x / rho, z.y / rho}) : Complex{};
  return {theta.im * phi.re, theta.im * phi.im, theta.re};
}

}  // namespace

double mandelbulb_distance(glm::dvec3 c) {
  constexpr int most_iterations = 12;
  constexpr double escape_radius = 4;
  glm::dvec3 z = c;
  double derivative = 1;  // |dz/dc| by the chain rule, where 8r⁷ approximates the norm of 8z⁷
  double r = std::sqrt(glm::dot(z, z));
  for (int n = 0; n < most_iterations && r < escape_radius; ++n) {
    const double r2 = r * r;
    derivative = 8 * (r2 * r2 * r2 * r) * derivative + 1;
    z = eighth_power(z) + c;
    r = std::sqrt(glm::dot(z, z));
  }
  return r < escape_radius ? 0 : 0.5 * r * logarithm(r) / derivative;
}

}  // namespace triptych::scene
