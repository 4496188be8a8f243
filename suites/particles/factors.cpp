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
using measure::Decides;
using measure::Factor;
using measure::number;
using measure::text;

// Any valid angle will do, because only the syntax of the camera's name is checked here.
constexpr double any_field_of_view = 60;

}  // namespace

const std::vector<Factor>& particle_factors() {
  static const std::vector<Factor> factors{
      measure::technique_factor("particles", "quad_instanced", "how the spheres are drawn"),
      text("data", "generate:uniform:10000",
           "a particle file (" + scene::particle_endings() +
               ", plain or compressed; FILE@K: its K-th frame), generate:NAME:COUNT, or "
               "stress:CASE:VARIANT (a stress scene)"),
      choice("colour", {"rgba8", "rgba32", "intensity"}, "rgba8", Decides::the_picture,
             "how a particle's colour is stored: four bytes, four floats, or an intensity that is "
             "looked up in the transfer function"),
      text("transfer_function", "haze",
           "colours for intensities: haze, surfaces, or a file with 256 RGBA entries"),
      choice("transfer", {"vertex", "pixel"}, "vertex", Decides::how_it_is_made,
             "the stage that looks up the transfer function"),
      choice("ray", {"vertex", "pixel"}, "pixel", Decides::how_it_is_made,
             "the stage that computes the ray"),
      choice("conservative_depth", {"off", "on"}, "off", Decides::how_it_is_made,
             "whether the shader declares that the surface lies behind its sprite"),
      choice("corners", {"4", "5", "6", "7", "8", "16", "32"}, "8", Decides::how_it_is_made,
             "number of corners of polygon_tess"),
      choice("culling", {"none", "frustum", "occlusion"}, "frustum", Decides::how_it_is_made,
             "which cells of particles are culled"),
      choice("structure", {"static", "refit", "rebuild"}, "static", Decides::how_it_is_made,
             "what each frame does with the hierarchy that rays traverse: nothing (static), refit "
             "it to moved spheres, or rebuild it"),
      number("radius_scale", 1e-6, 1e6, "1", Decides::the_picture,
             "factor by which every radius is multiplied"),
      text("camera", "orbit_y:1/8",
           "PATH:i/n (orbit_y:1/8, path_z:3/36, …), random:SEED or view:AZIMUTH/ELEVATION/DISTANCE "
           "(degrees, and orbit radii: view:45/20/0.8); own: the stress case's camera"),
      number("fov", 0.0005, 179, "60", Decides::the_picture,
             "vertical field of view in degrees; own: the stress case's value",
             {std::string(own_level)}),
      text("viewport", "256", "N for NxN, or WxH, in pixels; own: the stress case's viewport"),
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
