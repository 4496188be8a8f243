#pragma once
// Options for how particles are drawn, as opposed to the factors that define the image.

#include <cstdint>
#include <string_view>

namespace triptych::technique {

// The shader stage in which a quantity is computed, for quantities that either the vertex stage or
// the fragment stage can compute.
enum class ComputedAt : std::uint8_t { vertex, pixel };
// The cells that are culled: none, the cells outside the view, or the cells outside the view and
// the hidden cells.
enum class Culling : std::uint8_t { none, frustum, occlusion };
// What each frame does to the hierarchy or acceleration structure before rays traverse it: nothing,
// because it was built when the scene was prepared; refit its boxes to spheres that have moved; or
// rebuild it.
enum class Structure : std::uint8_t { built_once, refitted, rebuilt };
[[nodiscard]] std::string_view name_of(Structure structure);  // static, refit, rebuild
[[nodiscard]] Structure structure(std::string_view name);     // throws InputError
[[nodiscard]] std::string_view name_of(ComputedAt stage);
[[nodiscard]] std::string_view name_of(Culling culling);
[[nodiscard]] ComputedAt computed_at(std::string_view name);  // throws InputError
[[nodiscard]] Culling culling(std::string_view name);         // throws InputError

// Faults that can be injected to prove that the gate (Triptych's regression check) finds them. In
// shaders and kernels, a fault is a compile-time constant unless it only changes a parameter.
enum class ParticleFault : std::uint8_t {
  none = 0,
  small_sprite = 1,     // every sprite is 1 % smaller than the silhouette of its sphere
  unresolved_ties = 2,  // if depths are equal, the particle that is drawn last stays visible
  reversed_depth = 3,   // the farther of two surfaces stays visible
  wrong_sense = 4,      // early rejection uses the sphere's back instead of its front, and the
                        // conservative-depth qualifier is the opposite of the correct one
  culled_visible = 5,   // culling assumes a view that is half as wide as the real one
  lost_at_border = 6,   // a particle is not put into the last tile that it reaches
  missing_barrier = 7,  // a work group does not wait for data that its invocations share
  small_box = 8         // the box around a sphere is computed for half its radius
};

struct ParticleOptions {
  ComputedAt transfer = ComputedAt::vertex;  // where the transfer function is evaluated
  ComputedAt ray = ComputedAt::pixel;        // where the ray is computed
  bool conservative_depth = false;
  int corners = 4;  // number of corners for polygon_tess: 4…8, 16, 32
  Culling culling = Culling::frustum;
  Structure structure = Structure::built_once;
  ParticleFault fault = ParticleFault::none;
  // About 1/extra_work_stride of the particles or, for techniques that trace rays, of the rays are
  // processed twice. This injects a slowdown of about this share through real work that changes no
  // pixel. 0 disables it.
  int extra_work_stride = 0;
};

}  // namespace triptych::technique
