#pragma once
// Scenes that a device can draw and for which every pixel has a closed-form solution
// (closed_forms.hpp). The camera can be anywhere, because the solution is computed from the ray and
// the chord of each pixel.

#include <array>
#include <functional>
#include <optional>
#include <string_view>

#include "scene/volume_scene.hpp"

namespace triptych::reference {

// The problems, and the order of convergence of a midpoint renderer with step h, measured by the
// error against the closed-form solution. τ is the extinction (optical depth per unit of length),
// τ₀ is its value at z = 0, k is a constant, and H is the scale height:
// clang-format off
enum class AnalyticProblem {
  v1_constant,    // homogeneous box                          exact for every h
  v2_ramp,        // τ = k·z, colour linear in z              order 2 in h
  v3_segment,     // τ and colour linear in z, τ decreasing   order 2 in h
  v3_plateaus,    // like v3_segment, between two plateaus    order 2 in h; see below
  v4_gaussian,    // Gaussian blob in the middle of the box   order 2 in h and in the voxel size
  v5_atmosphere,  // τ = τ₀·e^(−z/H), constant colour         order 2 in h
  v6_layers,      // two homogeneous layers along z           irregular in h, at most order 1
  v7_shell,       // homogeneous between two spheres          irregular in h; order 2 in voxel size
  v8_trilinear,   // τ = k·xyz, constant colour               order 2 in h
  v9_wave,        // constant τ, lit by a sine gradient       order 2 in h and in the voxel size
};
// clang-format on
inline constexpr std::array analytic_problems{
    AnalyticProblem::v1_constant, AnalyticProblem::v2_ramp,     AnalyticProblem::v3_segment,
    AnalyticProblem::v3_plateaus, AnalyticProblem::v4_gaussian, AnalyticProblem::v5_atmosphere,
    AnalyticProblem::v6_layers,   AnalyticProblem::v7_shell,    AnalyticProblem::v8_trilinear,
    AnalyticProblem::v9_wave};
[[nodiscard]] std::string_view name_of(AnalyticProblem problem);
[[nodiscard]] std::optional<AnalyticProblem> analytic_problem(std::string_view name);
// Returns whether the image is shaded (with the defaults of scene::Shading).
[[nodiscard]] bool is_shaded(AnalyticProblem problem);

struct AnalyticOptions {
  std::array<int, 3> size{32, 32, 32};  // size in voxels; v6_layers needs an even number along z
  std::array<double, 3> spacing{1, 1, 1};
  int width = 32;
  int height = 32;
  double step_voxels = 1;
  // The default camera is outside the box, in a direction that is oblique to all axes, and sees the
  // whole box.
  std::optional<scene::Camera> camera;
  std::array<float, 4> background{0, 0, 0, 0};
};

struct AnalyticPixel {
  std::array<double, 4> rgba{};  // premultiplied, over the background
  // The largest difference in any channel between this closed-form solution and the exact integral
  // over the scene's grid and table, which represent the medium by finitely many floats.
  double model_error = 0;
};

// In each problem, the position determines a value g, and the table maps g to the medium. A voxel
// has the value x = (½ + 255·g)/256, so that table entry k is at g = k/255.
//
//   - The problems along z have g = z/L at voxel centres, where L is the extent of the box along z.
//     So g is exactly linear between the first and the last voxel centre. In the outermost half
//     voxels, the field is constant, and so is τ in the closed-form solution.
//   - v4_gaussian: g = e^(−r²/(2σ²)), with r the distance from the centre of the box and σ a tenth
//     of its smallest extent.
//   - v6_layers: g is 0 in one layer and 1 in the other.
//   - v7_shell: g is proportional to the distance from the centre, up to 1.
//   - v8_trilinear: g is the product of x, y and z, each divided by the extent of the box along its
//     axis. Trilinear interpolation reproduces this product.
//   - v9_wave, the only shaded problem, is a homogeneous box with g = a·(1 − cos(πz/L))/2, which
//     is half a period of a wave. The wave is symmetric about both faces. A grid that is clamped to
//     the edge is symmetric in the same way, because the value of the last voxel continues beyond
//     the face. The amplitude a keeps the gradient below nine tenths of
//     scene::Shading::gradient_floor, so that brightness is proportional to the gradient.
//   - v3_plateaus: the medium is constant on two plateaus, which are the lowest and the highest
//     fifth of z. The field has its kinks at the outermost voxel centres, which are on the
//     plateaus. The medium has its kinks at table entries. An integration rule that is exact for a
//     linear field therefore has only rounding errors, unless a single step contains both a kink of
//     the field and a kink of the medium. Along z, these kinks are n/5 − ½ voxels apart, with n the
//     number of voxels along z.
//
// Derivation of the model error, with u the smallest spacing, α(g) = 1 − e^(−u·τ(g)), and its
// derivatives α' and α'' with respect to g: interpolating α over 1/255 has an error of at most
// (1/255)²/8·max|α''|, and rounding to float adds 2⁻²⁴·(α + |α'|). Dividing the sum of these errors
// by u·(1 − α) gives the error of τ. Multiplying that by the length of the chord gives the error of
// the image, because the colour of the medium and the colour behind it differ by at most 1. Some
// problems have additional errors:
//
//   - v4_gaussian: the error of trilinear interpolation, Σ Δᵢ²/8·|∂ᵢ²g|, integrated along the ray,
//     where Δᵢ is the spacing along axis i.
//   - v6_layers: the transition between the layers, which is 1/255 voxel thick.
//   - v7_shell: the part of the ray that is so close to a face that table and interpolation may
//     move it to the other side of the face.
//   - v9_wave: the error of the gradient. With k = π/L, the spacing Δ along z and the steepest
//     gradient m, central differences have an error of (kΔ)²/6·m. Their interpolation has an error
//     of (kΔ)²/8·m, or of at most kΔ/2·m in the outermost half voxels. The rounding of two voxels
//     adds 2⁻²⁴ of their value.
struct AnalyticScene {
  scene::VolumeScene scene;
  std::function<AnalyticPixel(int x, int y)> exact;
};

// Throws InputError for an odd number of layers in v6_layers and for a size below 1.
[[nodiscard]] AnalyticScene analytic_scene(AnalyticProblem problem, const AnalyticOptions& options);

}  // namespace triptych::reference
