#include "suites/volume/factors.hpp"

#include "measure/contract/factor.hpp"
#include "scene/camera.hpp"
#include "scene/format_advice.hpp"
#include "scene/transfer_function.hpp"
#include "scene/value_window.hpp"
#include "scene/volume.hpp"
#include "suites/volume/analytic_data.hpp"
#include "suites/volume/stress_cases.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::volume_suite {
namespace {

using measure::choice;
using measure::Factor;
using measure::FactorRole;
using measure::number;
using measure::text;

// Marks a factor that was added after the first scenes had been stored. The names of scenes omit
// this factor if it has its default level, so that the names of stored scenes stay valid.
Factor with_silent_default(Factor factor) {
  factor.silent_default = true;
  return factor;
}

}  // namespace

const std::vector<Factor>& volume_factors() {
  static const std::vector<Factor> factors{
      measure::technique_factor("volume", "raycast", "the technique that draws the image"),
      text("data", "generate:mandelbulb:96",
           "a volume file (" + scene::volume_endings() +
               ", plain or compressed; FILE:NXxNYxNZ:TYPE for voxels without a header), "
               "generate:NAME:SIZE, generate:NAME:NXxNYxNZ, "
               "analytic:PROBLEM:SIZE (a scene with an exact solution), or stress:CASE:VARIANT "
               "(a stress scene)"),
      choice(
          "voxel", {"auto", "u8", "u16", "f32", "f16"}, "auto", FactorRole::method,
          "how voxels are stored on the device: as 8- or 16-bit integers, floats, or half floats "
          "(f16); auto: the fastest combination of the factors voxel and sampler that is exact on "
          "the device"),
      choice(
          "sampler", {"auto", "hardware", "manual", "packed"}, "auto", FactorRole::method,
          "how voxels are interpolated: by the hardware sampler, by the kernel (manual), or by the "
          "kernel from packed cells of eight voxels; auto: the fastest combination of the "
          "factors voxel and sampler that is exact on the device"),
      with_silent_default(
          text("window", "full",
               "the range of values that the transfer function spans: full, or LOW..HIGH in the "
               "data's units or percentiles (p1..p99, 0..p99.5); values outside are clamped")),
      with_silent_default(choice(
          "mapping", {"linear", "log"}, "linear", FactorRole::scene,
          "how values in the window are mapped to the transfer function: linearly, or by their "
          "logarithm (log), with values below the smallest positive value mapped to 0")),
      with_silent_default(
          text("component", "0",
               "the component to draw if the data have several values per voxel, such as "
               "colours, vectors or time steps: a 0-based index, or magnitude for the "
               "Euclidean norm of all components")),
      text("transfer_function", "haze",
           "the transfer function, which maps values to colours and opacities: the preset haze or "
           "surfaces, or a file with 256 lines of four numbers, R G B A, from 0 to 1 or from 0 to "
           "255; own: the transfer function of the analytic problem or stress case (surfaces for "
           "all other data)"),
      number("step", 1.0 / 64, 4096, "1", FactorRole::scene,
             "the distance between samples in units of the smallest voxel spacing; own: the stress "
             "case's step (1 for all other data)",
             {std::string(own_level)}),
      choice(
          "quadrature", {"midpoint", "preintegrated", "cells", std::string(own_level)}, "midpoint",
          FactorRole::scene,
          "the rule for the ray integral; midpoint: one sample for each step; preintegrated: the "
          "transfer function is integrated between the values at both ends of a step; cells: a "
          "fourth-order rule, for which rays are cut at the planes through voxel centres and at "
          "the kinks of the transfer function, and are divided into ⌈1/step⌉ equal parts between "
          "two such planes; own: the stress case's rule (midpoint for all other data)"),
      choice("shading", {"none", "gradient", std::string(own_level)}, "none", FactorRole::scene,
             "none, or gradient: shading by a headlight, with gradients computed by central "
             "differences; own: the stress case's shading (none for all other data)"),
      choice("skip", {"none", "bricks", "distance"},
             std::string(technique::name_of(technique::RaycastOptions{}.skip)), FactorRole::method,
             "how empty space is skipped: not at all, brick by brick, or by leaps over several "
             "bricks (distance)"),
      number("ert", 0, 0.5, "0.001953125", FactorRole::method,
             "early ray termination: the transmittance below which a ray ends, or 0 for never; the "
             "default is half an 8-bit step; own: the stress case's value (the default for all "
             "other data)",
             {std::string(own_level)}),
      number("adapt", 0, 0.5, "0", FactorRole::method,
             "the error allowed for merging the samples of a nearly homogeneous brick into one "
             "sample; a value above 0 requires skip=bricks"),
      choice("precision", {"fp32", "fp64"}, "fp32", FactorRole::method,
             "the precision of rays, interpolation and compositing; fp64 requires sampler=manual "
             "or sampler=packed, and sampler=auto then selects one of them"),
      number(
          "budget", 0x1.0p-10, 1 << 20, std::string(no_budget), FactorRole::method,
          "the limit on device memory for voxels, in MiB; a larger volume is drawn in parts, front "
          "to back, and every frame uploads the parts again; none: only the device's limits apply",
          {std::string(no_budget)}),
      text(
          "camera", "orbit_y:1/8",
          "PATH:i/n (such as orbit_y:1/8 or path_z:3/36), random:SEED, or "
          "view:AZIMUTH/ELEVATION/DISTANCE (angles in degrees and distance in orbit radii, such as "
          "view:45/20/0.8); own: the stress case's camera (orbit_y:1/8 for all other data)"),
      text(
          "viewport", "256",
          "the image size in pixels: N for NxN, or WxH; own: the stress case's image size (256 for "
          "all other data)"),
  };
  return factors;
}

void check_value(const Factor& factor, std::string_view value,
                 const std::vector<std::filesystem::path>& folders) {
  if (value == own_level && factor.name != "data" && factor.name != "window" &&
      factor.name != "component") {
    return;
  }
  if (factor.name == "viewport") {
    static_cast<void>(measure::parse_viewport(value));
  } else if (factor.name == "camera") {
    static_cast<void>(scene::camera_at(value, scene::Box{}, field_of_view));
  } else if (factor.name == "data") {
    scene::check_generated_volume(value);
    static_cast<void>(analytic_data(value));
    static_cast<void>(stress_data(value));
  } else if (factor.name == "component") {
    static_cast<void>(scene::parse_component(value));
  } else if (factor.name == "window") {
    static_cast<void>(scene::parse_window(value));
  } else if (factor.name == "transfer_function") {
    static_cast<void>(scene::load_transfer_function(value, folders));
  }
}

}  // namespace triptych::volume_suite
