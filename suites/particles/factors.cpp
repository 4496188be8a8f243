#include "suites/particles/factors.hpp"

#include "measure/contract/factor.hpp"
#include "scene/camera.hpp"
#include "scene/format_advice.hpp"
#include "scene/particles.hpp"
#include "scene/transfer_function.hpp"
#include "suites/particles/stress_cases.hpp"

namespace triptych::particles_suite {
namespace {

using measure::choice;
using measure::Factor;
using measure::FactorRole;
using measure::number;
using measure::text;

// Any valid angle will do, because only the syntax of the camera's name is checked here.
constexpr double any_field_of_view = 60;

}  // namespace

const std::vector<Factor>& particle_factors() {
  static const std::vector<Factor> factors{
      measure::technique_factor("particles", "quad_instanced",
                                "the technique that draws the spheres"),
      text("data", "generate:uniform:10000",
           "a particle file (" + scene::particle_endings() +
               ", plain or compressed; FILE@K selects frame K, counting from 0), "
               "generate:NAME:COUNT, or stress:CASE:VARIANT (a stress scene)"),
      choice("colour", {"rgba8", "rgba32", "intensity"}, "rgba8", FactorRole::scene,
             "how each particle's colour is stored: as four bytes (rgba8), as four floats "
             "(rgba32), or as an intensity that is looked up in the transfer function; the "
             "intensity comes from the file (MMPLD) or is the rank of the particle's element or "
             "type, divided by the number of elements or types"),
      text("transfer_function", "haze",
           "the transfer function, which maps intensities to colours: the preset haze or surfaces, "
           "or a file with 256 lines of four numbers, R G B A, from 0 to 1 or from 0 to 255"),
      choice("transfer", {"vertex", "pixel"}, "vertex", FactorRole::method,
             "the shader stage that looks up colours in the transfer function"),
      choice("ray", {"vertex", "pixel"}, "pixel", FactorRole::method,
             "the shader stage that computes the rays"),
      choice("conservative_depth", {"off", "on"}, "off", FactorRole::method,
             "whether the shader declares conservative depth (depth_less), which is correct "
             "because each surface point lies behind its sprite; hidden fragments can then be "
             "rejected early"),
      choice("corners", {"4", "5", "6", "7", "8", "16", "32"}, "8", FactorRole::method,
             "the number of corners of each polygon that polygon_tess draws"),
      choice("culling", {"none", "frustum", "occlusion"}, "frustum", FactorRole::method,
             "which cells (groups of neighbouring particles) are culled: none, those outside the "
             "view frustum, or also those hidden behind other particles (occlusion)"),
      choice("structure", {"static", "refit", "rebuild"}, "static", FactorRole::method,
             "how each frame updates the hierarchy that rays traverse: not at all (static), by "
             "refitting it to the moved spheres, or by rebuilding it"),
      number("radius_scale", 1e-6, 1e6, "1", FactorRole::scene,
             "the factor by which every radius is multiplied"),
      text(
          "camera", "orbit_y:1/8",
          "PATH:i/n (such as orbit_y:1/8 or path_z:3/36), random:SEED, or "
          "view:AZIMUTH/ELEVATION/DISTANCE (angles in degrees and distance in orbit radii, such as "
          "view:45/20/0.8); own: the stress case's camera"),
      number("fov", 0.0005, 179, "60", FactorRole::scene,
             "the vertical field of view in degrees; own: the stress case's field of view",
             {std::string(own_level)}),
      text("viewport", "256",
           "the image size in pixels: N for NxN, or WxH; own: the stress case's viewport"),
  };
  return factors;
}

void check_value(const Factor& factor, std::string_view value,
                 const std::vector<std::filesystem::path>& folders) {
  if (factor.name == "viewport") {
    if (value != own_level) static_cast<void>(measure::parse_viewport(value));
  } else if (factor.name == "camera") {
    if (value != own_level) {
      static_cast<void>(scene::camera_at(value, scene::Box{}, any_field_of_view));
    }
  } else if (factor.name == "data") {
    scene::check_generated_particles(value);
    static_cast<void>(stress_data(value));
  } else if (factor.name == "transfer_function") {
    static_cast<void>(scene::load_transfer_function(value, folders));
  }
}

}  // namespace triptych::particles_suite
