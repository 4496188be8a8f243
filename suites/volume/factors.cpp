#include "suites/volume/factors.hpp"

#include "measure/contract/factor.hpp"
#include "scene/camera.hpp"
#include "scene/transfer_function.hpp"
#include "scene/value_window.hpp"
#include "scene/volume.hpp"
#include "suites/volume/analytic_data.hpp"
#include "suites/volume/stress_cases.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::volume_suite {
namespace {

using measure::choice;
using measure::Decides;
using measure::Factor;
using measure::number;
using measure::text;

// What came after the first scenes were stored.
Factor silent(Factor factor) {
  factor.silent_default = true;
  return factor;
}

}  // namespace

const std::vector<Factor>& volume_factors() {
  static const std::vector<Factor> factors{
      measure::technique_factor("volume", "raycast", "how the picture is made"),
      text("data", "generate:mandelbulb:96",
           "a volume file (.nrrd, .nhdr, .dat), generate:NAME:SIZE, generate:NAME:NXxNYxNZ, "
           "analytic:PROBLEM:SIZE, known by a formula, or stress:CASE:VARIANT"),
      choice("voxel", {"auto", "u8", "u16", "f32", "f16"}, "auto", Decides::how_it_is_made,
             "how voxels are stored on the device, f16: as half floats; auto: the device's fastest "
             "exact path"),
      choice(
          "sampler", {"auto", "hardware", "manual", "packed"}, "auto", Decides::how_it_is_made,
          "who interpolates between voxels: the device's sampler, the kernel, or the kernel from "
          "cells of eight; auto: as for voxel"),
      silent(
          text("window", "full",
               "values that the transfer function spans: full, or LOW..HIGH in the data's units or "
               "percentiles (p1..p99, 0..p99.5); voxels beyond are clamped to its ends")),
      silent(choice("mapping", {"linear", "log"}, "linear", Decides::the_picture,
                    "of a voxel's value to the window; log: of its logarithm, below the smallest "
                    "positive value 0")),
      text("transfer_function", "haze",
           "haze, surfaces, a file of 256 RGBA entries, or own: an analytic problem's or stress "
           "case's own, surfaces for all other data"),
      number("step", 1.0 / 64, 4096, "1", Decides::the_picture,
             "distance of samples in smallest voxel spacings; own, here and below: a stress case's "
             "own, the default for all other data",
             {std::string(own_level)}),
      choice("quadrature", {"midpoint", "preintegrated", "cells", std::string(own_level)},
             "midpoint", Decides::the_picture,
             "rule for the ray integral: one sample for a step; the transfer function integrated "
             "between the values at its ends; or, of fourth order, from voxel plane to voxel plane "
             "in ⌈1/step⌉ parts and at the kinks of the transfer function"),
      choice("shading", {"none", "gradient", std::string(own_level)}, "none", Decides::the_picture,
             "headlight from central differences"),
      choice("skip", {"none", "bricks", "distance"},
             std::string(technique::name_of(technique::RaycastOptions{}.skip)),
             Decides::how_it_is_made, "how empty space is skipped"),
      number("ert", 0, 0.5, "0.001953125", Decides::how_it_is_made,
             "transmittance below which a ray ends; 0: never. The default is half an 8-bit step",
             {std::string(own_level)}),
      number("adapt", 0, 0.5, "0", Decides::how_it_is_made,
             "error that may be spent on taking the samples of a nearly homogeneous brick as one; "
             "needs skip bricks"),
      choice("precision", {"fp32", "fp64"}, "fp32", Decides::how_it_is_made,
             "what rays, interpolation and compositing are computed in; fp64 needs sampler manual "
             "or packed, one of which auto then is"),
      number(
          "budget", 0x1.0p-10, 1 << 20, std::string(no_budget), Decides::how_it_is_made,
          "MiB of device memory for voxels: a volume that takes more is drawn in parts, front to "
          "back, and moved there in every frame; none: as many as the device's limits allow",
          {std::string(no_budget)}),
      text("camera", "orbit_y:1/8", "PATH:i/n (orbit_y:1/8, path_z:3/36, …), random:SEED, or own"),
      text("viewport", "256", "N for NxN, or WxH, in pixels, or own"),
  };
  return factors;
}

void check_value(const Factor& factor, std::string_view value,
                 const std::vector<std::filesystem::path>& folders) {
  if (value == own_level && factor.name != "data" && factor.name != "window") return;
  if (factor.name == "viewport") {
    static_cast<void>(measure::parse_viewport(value));
  } else if (factor.name == "camera") {
    static_cast<void>(scene::camera_at(value, scene::Box{}, field_of_view));
  } else if (factor.name == "data") {
    scene::check_generated_volume(value);
    static_cast<void>(analytic_data(value));
    static_cast<void>(stress_data(value));
  } else if (factor.name == "window") {
    static_cast<void>(scene::parse_window(value));
  } else if (factor.name == "transfer_function") {
    static_cast<void>(scene::load_transfer_function(value, folders));
  }
}

}  // namespace triptych::volume_suite
