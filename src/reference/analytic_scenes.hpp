#pragma once
// Scenes whose every pixel is known in closed form (closed_forms.hpp), ready to be drawn on a
// device. A perspective camera sees them from anywhere: each pixel's own ray and chord enter the
// formula.

#include <array>
#include <functional>
#include <optional>
#include <string_view>

#include "scene/volume_scene.hpp"

namespace triptych::reference {

// What a midpoint renderer of step h does on each (errors against the closed form):
enum class AnalyticProblem {
  v1_constant,    // homogeneous box                          exact for every h
  v2_ramp,        // τ = k·z, colour linear in z              order 2 in h
  v3_segment,     // τ and colour linear in z, τ falling      order 2 in h
  v3_plateaus,    // the same between two plateaus            order 2 in h; see below
  v4_gaussian,    // Gaussian blob in the middle of the box   order 2 in h and in the voxel size
  v5_atmosphere,  // τ = τ₀·e^(−z/H), constant colour         order 2 in h
  v6_layers,  // two homogeneous layers across z          ≤ 1 and erratic in h: the edge limits it
  v7_shell,   // homogeneous between two spheres           the same; 2 in the voxel size
  v8_trilinear,  // τ = k·xyz, constant colour                order 2 in h
  v9_wave,       // constant τ, lit by a sine wave's gradient order 2 in h and in the voxel size
};
inline constexpr std::array analytic_problems{
    AnalyticProblem::v1_constant, AnalyticProblem::v2_ramp,     AnalyticProblem::v3_segment,
    AnalyticProblem::v3_plateaus, AnalyticProblem::v4_gaussian, AnalyticProblem::v5_atmosphere,
    AnalyticProblem::v6_layers,   AnalyticProblem::v7_shell,    AnalyticProblem::v8_trilinear,
    AnalyticProblem::v9_wave};
[[nodiscard]] std::string_view name_of(AnalyticProblem problem);
[[nodiscard]] std::optional<AnalyticProblem> analytic_problem(std::string_view name);
// Whether its picture is one with shading, by the defaults of scene::Shading.
[[nodiscard]] bool is_shaded(AnalyticProblem problem);

struct AnalyticOptions {
  std::array<int, 3> size{32, 32, 32};  // voxels; v6_layers needs an even number along z
  std::array<double, 3> spacing{1, 1, 1};
  int width = 32;
  int height = 32;
  double step_voxels = 1;
  std::optional<scene::Camera>
      camera;  // none: from outside, oblique to all axes, all of the box in view
  std::array<float, 4> background{0, 0, 0, 0};
};

struct AnalyticPixel {
  std::array<double, 4> rgba{};  // premultiplied, background included
  // Largest difference of any channel between this closed form and the exact integral over the
  // scene's own grid and table, by which it is represented with finitely many floats.
  double model_error = 0;
};

// Grids vary with position as the table needs it: a voxel holds x = (½ + 255·g)/256, so that table
// entry k is at g = k/255. The problems along z have g = z/L at voxel centres, thus exactly linear
// between the first and the last; outside, in the outermost half voxels, the field is constant, and
// so is τ in the closed form. v4_gaussian has g = e^(−r²/2σ²), σ a tenth of the smallest extent;
// v6_layers g = 0 and 1; v7_shell the distance from the centre; v8_trilinear the product of the
// three heights, which trilinear interpolation reproduces. v9_wave, the only one that is shaded, is
// a homogeneous box with g = a·(1 − cos(πz/L))/2: half a wave, even about both faces, as clamping
// to the edge makes the grid; `a` keeps its gradient below nine tenths of the shading's floor, so
// that colours are as bright as it is steep. The field's kinks, at the outermost voxel centres, lie
// on v3_plateaus' plateaus, the lowest and the highest fifth of z, and the kinks of its medium at
// table entries: a rule that is exact where the field is straight errs by rounding alone while the
// step's share along z reaches no farther than from a kink of the field to one of the medium,
// size/5 − ½ voxels.
//
// The model's error, with u the smallest spacing and α(g) = 1 − e^(−u·τ(g)): interpolating α over
// 1/255 errs by at most (1/255)²/8·max|α''|; rounding to float adds 2⁻²⁴·(α + |α'|); both become
// one of τ divided by u·(1 − α), and one of the picture multiplied by the chord, as no |c − colour
// behind| exceeds 1. v4_gaussian adds that of trilinear interpolation, Σ Δᵢ²/8·|∂ᵢ²g|, integrated
// along the ray; v6_layers the transition, 1/255 voxel thick; v7_shell the part of the ray that is
// so near a face that table and interpolation may put it on the other side;
// v9_wave the gradient: with k = π/L, Δ the spacing along z and m the steepest gradient, central
// differences err by (kΔ)²/6·m, their interpolation by (kΔ)²/8·m, by kΔ/2·m in the outermost half
// voxels, where neither exceeds that, and rounding of two voxels by 2⁻²⁴ of their value.
struct AnalyticScene {
  scene::VolumeScene scene;
  std::function<AnalyticPixel(int x, int y)> exact;
};

// Throws InputError for an odd number of layers in v6_layers or a size below 1.
[[nodiscard]] AnalyticScene analytic_scene(AnalyticProblem problem, const AnalyticOptions& options);

}  // namespace triptych::reference
