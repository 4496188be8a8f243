#pragma once
// Options for drawing particles: the factors that do not determine the image.

#include <cstdint>
#include <string_view>

namespace triptych::technique {

// The stage that computes something that both the vertex stage and the fragment stage could
// compute.
enum class ComputedAt : std::uint8_t { vertex, pixel };
// Which cells are left out: none, those outside the view, or also those that are hidden.
enum class Culling : std::uint8_t { none, frustum, occlusion };
// The work of a frame on a hierarchy or an acceleration structure before rays traverse it: none,
// because it was built when the scene was prepared; fitting the boxes to spheres that moved; or
// building all of it again.
enum class Structure : std::uint8_t { built_once, refitted, rebuilt };
[[nodiscard]] std::string_view name_of(Structure structure);  // static, refit, rebuild
[[nodiscard]] Structure structure(std::string_view name);     // throws InputError
[[nodiscard]] std::string_view name_of(ComputedAt stage);
[[nodiscard]] std::string_view name_of(Culling culling);
[[nodiscard]] ComputedAt computed_at(std::string_view name);  // throws InputError
[[nodiscard]] Culling culling(std::string_view name);         // throws InputError

// Faults that can be injected to prove that the gate finds them. They are compile-time constants of
// shaders and kernels unless they are parameters.
enum class ParticleFault : std::uint8_t {
  none = 0,
  small_sprite = 1,     // the radius of every sprite is 1 % smaller than that of the silhouette
  unresolved_ties = 2,  // if depths are equal, the last one drawn is kept
  reversed_depth = 3,   // of two depths the farther one is kept
  wrong_sense = 4,      // early rejection takes the sphere's back for its front; the shader
                        // promises the opposite of what conservative depth does
  culled_visible = 5,   // the view is assumed to be half as wide as it is
  lost_at_border = 6,   // a particle is not put into the last tile that it reaches
  missing_barrier = 7,  // a work group does not wait for data that its invocations share
  small_box = 8         // the box around a sphere is made for half its radius
};

struct ParticleOptions {
  ComputedAt transfer = ComputedAt::vertex;  // where the transfer function is evaluated
  ComputedAt ray = ComputedAt::pixel;        // where the ray is computed
  bool conservative_depth = false;
  int corners = 4;  // for polygon_tess: 4…8, 16, 32
  Culling culling = Culling::frustum;
  Structure structure = Structure::built_once;
  ParticleFault fault = ParticleFault::none;
  // Every extra_work_stride-th particle (in evenly distributed runs) is drawn twice. This is an
  // injected slowdown by about 1/stride, with real work that changes no pixel; 0: none.
  int extra_work_stride = 0;
};

}  // namespace triptych::technique
