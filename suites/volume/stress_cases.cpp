#include "suites/volume/stress_cases.hpp"

#include <algorithm>
#include <utility>

#include "suites/volume/stress_scenes.hpp"

namespace triptych::volume_suite {
namespace {

std::vector<StressCase> cases_of_geometry() {
  return {
      {1,
       "inside",
       "the eye is inside the volume, in one variant exactly at the centre of a voxel",
       "rays begin at the eye, because the point where they would enter the box is behind the eye, "
       "and its distance is replaced by 0",
       {"middle", "voxel"},
       stress_inside},
      {2,
       "boundary",
       "the eye is on a face, an edge or a corner of the volume, or on a face and looking away",
       "rays that point inward enter at distance 0; if the camera looks away, all rays have length "
       "0 inside the box, and the image is the background",
       {"face", "edge", "corner", "away"},
       stress_boundary},
      {3,
       "parallel",
       "ray directions have a component of ±0, and the rays begin in the plane of a face",
       "the intersection with the box never computes 0·∞, because nothing is divided by a "
       "component of ±0: such a ray is inside the box for its whole length or not at all; rounding "
       "decides which, and the error bound covers both cases",
       {"lower", "upper", "negative_zero"},
       stress_parallel},
      {4,
       "within_face",
       "rays lie in a face, and one ray lies in an edge",
       "every pixel is finite, and any part of such a ray may count as inside the box",
       {"face", "edge"},
       stress_within_face},
      {5,
       "chord",
       "rays clip an edge or a corner of the box, so their chord lengths tend to 0",
       "opacity tends to 0 with the chord length s, because the opacity of a sample of length s, "
       "1 − (1 − α)^s for an opacity α per unit of length, is computed without cancellation; a ray "
       "of length 0 takes no sample",
       {"edge", "corner"},
       stress_chord},
      {6,
       "octant",
       "volume and camera are mirrored into all eight octants",
       "each image equals the image of variant ppp, mirrored horizontally if an odd number of axes "
       "is mirrored, within the sum of both error bounds, but is not bit-identical to it, because "
       "a coordinate and its mirrored value are rounded differently",
       {"ppp", "mpp", "pmp", "mmp", "ppm", "mpm", "pmm", "mmm"},
       stress_octant},
      {7,
       "far",
       "the eye is 10³ to 10⁷ voxels away, and the focal length grows with the distance; a large "
       "offset in world space needs no case of its own, because every volume begins at the origin, "
       "so that an offset could only move the eye",
       "the image is the same as from nearby, because rays begin on a plane in front of the box "
       "whose position is computed in double precision, so the distance causes no round-off",
       {"1e3", "1e4", "1e5", "1e6", "1e7"},
       stress_far},
  };
}

std::vector<StressCase> cases_of_size() {
  return {
      {8,
       "scale",
       "world units are scaled by 2^±20, and extinction by the inverse factor",
       "the image is bit-identical to the image with scale 1, because multiplying by a power of "
       "two causes no rounding, and no threshold is given in world units",
       {"one", "up", "down"},
       stress_scale},
      {9,
       "spacing",
       "voxels have aspect ratios of 1:1:8 and 1:1:1000",
       "the image is within an error bound that measures lengths in units of the smallest spacing, "
       "because a rounding error of a given length spans the most voxels along the axis with this "
       "spacing",
       {"8", "1000"},
       stress_spacing},
      {10,
       "slice",
       "the volume is one voxel thick along x, y or z",
       "the field is constant along that axis, because it is clamped at the edge and two equal "
       "neighbours interpolate to the same value",
       {"x", "y", "z"},
       stress_slice},
      {11,
       "tiny",
       "the volume has 1×1×1 or 2×2×2 voxels",
       "the field is clamped at the edge on all axes",
       {"1", "2"},
       stress_tiny},
      {12,
       "prime",
       "the volume has 13×31×17 voxels: no size is a multiple of a brick size, a work-group size "
       "or an alignment",
       "rows are read from the correct addresses, and the last bricks contain the remaining voxels",
       {},
       stress_prime},
      {13,
       "oversize",
       "the volume has 20000 voxels along x, more than any texture may have",
       "samplers that read voxels from a buffer draw the volume; all other samplers need a "
       "texture, so they reject the volume with a message that states its size and the device's "
       "limit",
       {},
       stress_oversize},
      {14,
       "unseen",
       "the volume is behind the eye, or outside the frustum",
       "there are no samples, and the image is exactly the background",
       {"behind", "beside"},
       stress_unseen},
  };
}

std::vector<StressCase> cases_of_voxels() {
  return {
      {15,
       "format",
       "the same field is stored in 8, 16 and 32 bits",
       "the images agree within the sum of both error bounds, because 255 and 65535 are both "
       "mapped to exactly 1",
       {"f32", "u8", "u16"},
       stress_format},
      {16,
       "nan",
       "some voxels are NaN: one voxel, a block, every second voxel, or one voxel in a shaded "
       "scene",
       "the image is bit-identical to the image of a volume with 0 instead of NaN (the transfer "
       "function is transparent at 0), because NaN is replaced when voxels are prepared and never "
       "reaches a device",
       {"zero_one", "nan_one", "zero_block", "nan_block", "zero_mesh", "nan_mesh", "zero_shaded",
        "nan_shaded"},
       stress_nan},
      {17,
       "infinite",
       "some voxels are ±∞",
       "the image is bit-identical to the image of a volume with the ends of the value range "
       "instead of ±∞",
       {"upper", "plus", "lower", "minus"},
       stress_infinite},
      {18,
       "denormal",
       "voxels, opacities, colours or transmittances are denormal",
       "denormal data become 0 before they reach a device (tests/contract/stress_test.cpp checks "
       "this); denormals that are computed along a ray may be kept or flushed to 0, which changes "
       "no channel by more than 2⁻¹²⁶",
       {"voxels", "opacity", "colour", "transmittance"},
       stress_denormal},
      {19,
       "flat",
       "all voxels have the same value; in two variants (floats or bytes), both ends of the value "
       "range are equal to this value, so the range is empty; in the other two (without or with "
       "shading), the range is not empty",
       "an empty range maps everything to 0; where the gradient is 0, the cosine between the "
       "gradient and the ray is 0 as well, because its divisor has a lower limit",
       {"range_f32", "range_u8", "plain", "shaded"},
       stress_flat},
  };
}

std::vector<StressCase> cases_of_transfer() {
  return {
      {20,
       "solid",
       "opacity is exactly 1",
       "the opacity of a sample of length s, 1 − (1 − 1)^s, is 1 and not NaN, so the image has "
       "exactly one colour",
       {},
       stress_solid},
      {21,
       "nearly_solid",
       "the opacity α is 1 − 2⁻²⁴, the largest float below 1",
       "1 − α is exact, so every form of the opacity correction stays within its bound",
       {"root", "square", "any"},
       stress_nearly_solid},
      {22,
       "faint",
       "100,000 samples of opacity 2⁻²⁰",
       "the opacity along the cube is 1 − (1 − 2⁻²⁰)^100000 = 0.091, with a relative error of at "
       "most 4 · 2⁻²⁴ per sample",
       {},
       stress_faint},
      {23,
       "march",
       "100,000 and 1,000,000 steps through a varying field",
       "sample i is at the distance (i + ½)·h for a step h, and floats represent i + ½ exactly up "
       "to 2²³, so positions do not drift; the relative error of the image is at most 4 · 2⁻²⁴ per "
       "sample",
       {"1e5", "1e6"},
       stress_march},
      {24,
       "stride",
       "the step is twice or a thousand times the volume's diagonal",
       "each ray takes one sample for its whole chord; the position of this sample is half a step "
       "behind the entry point and therefore outside the volume, where the field has the value of "
       "the nearest edge",
       {"twice", "thousand"},
       stress_stride},
      {25,
       "spike",
       "only one of 256 transfer-function entries is visible, and a step can miss it",
       "the same samples hit or miss the entry on the device and in the reference; if rounding "
       "decides, the error bound covers both results; with pre-integration, no step misses it",
       {"low", "middle", "preintegrated"},
       stress_spike},
      {26,
       "end_spike",
       "only the first or the last transfer-function entry is visible",
       "values up to half an entry beyond the centre of this entry have its colour, and skipping "
       "must not treat the end of the range as empty",
       {"first", "last"},
       stress_end_spike},
      {27,
       "slope",
       "opacity changes linearly along rays, with slopes as small as ±1e-7, and with slope 0",
       "pre-integrated steps are computed without cancellation, even if the slope is nearly 0",
       {"0.03", "1e-4", "1e-7", "0", "-1e-7", "-0.03"},
       stress_slope},
      {28,
       "edit",
       "transfer functions are random, with sequences of adjacent visible entries "
       "(tests/contract/stress_test.cpp tests 100 of them)",
       "for every transfer function, the image with skipping is bit-identical to the image without "
       "it",
       {"1", "2", "3", "4", "5", "6", "7", "8"},
       stress_edit},
      {29,
       "transparent",
       "the transfer function has no opacity at all",
       "the image is exactly the background; skip=distance takes no sample, and skip=bricks takes "
       "at most one sample per ray",
       {},
       stress_transparent},
      {30,
       "opaque",
       "everything is fully opaque, so rays end early",
       "each ray takes at most two samples",
       {},
       stress_opaque},
      {31,
       "lit_everywhere",
       "each brick has one visible voxel, so nothing can be skipped",
       "with skipping, a ray takes at most 1.1 times as many samples as without skipping",
       {},
       stress_lit_everywhere},
      {32,
       "lit",
       "one visible voxel is on a brick's face, edge or corner, or in the first or last layer",
       "the voxel is visible, because the value range of each brick includes a border of one "
       "voxel, so no sample near the voxel is skipped",
       {"face", "edge", "corner", "first", "last"},
       stress_lit},
  };
}

std::vector<StressCase> cases_of_frame() {
  return {
      {51,
       "shape",
       "the image has 1×1, 1×13, 17×1 or 17×13 pixels",
       "each smaller image equals a part of the largest one within the sum of both error bounds, "
       "because incomplete work groups draw only their own pixels",
       {"17x13", "1x1", "1x13", "17x1"},
       stress_shape},
      {52,
       "widest",
       "the image is 16384 pixels wide, or one pixel wider",
       "both images are drawn, but a device may reject the wider one with a message that states "
       "the image's size and the device's limit",
       {"16384", "16385"},
       stress_widest},
      {53,
       "field_of_view",
       "the field of view is 0.001° or 179°",
       "the image is within its bound, because the error of a direction does not depend on the "
       "field of view: every ray direction is computed as a sum of three products",
       {"narrowest", "widest"},
       stress_field_of_view},
      {54,
       "asymmetric",
       "the scene has no symmetry, and the image is square",
       "the image matches the reference image; every flipped image would differ by far more than "
       "the bound",
       {},
       stress_asymmetric},
      {56,
       "halves",
       "integer voxels reach 65504 (the largest half float) or 65535 (beyond it), or float voxels "
       "would become subnormal half floats",
       "with voxel=f16, integers up to 65504 are exact, and all other values are scaled to the "
       "range of half floats, so that none becomes subnormal or infinite",
       {"largest", "beyond", "subnormal"},
       stress_halves},
  };
}

std::vector<StressCase> all_cases() {
  std::vector<StressCase> cases;
  for (auto part :
       {cases_of_geometry, cases_of_size, cases_of_voxels, cases_of_transfer, cases_of_frame}) {
    std::ranges::move(part(), std::back_inserter(cases));
  }
  return cases;
}

}  // namespace

const std::vector<StressCase>& stress_cases() {
  static const std::vector<StressCase> cases = all_cases();
  return cases;
}

std::string name_of(const StressData& data) {
  return measure::stress_name(data);
}

std::optional<StressData> stress_data(std::string_view data) {
  return measure::choose_stress(data, stress_cases());
}

StressScene stress_scene(const StressData& data) {
  StressScene scene = data.of->scene(data.variant);
  scene.volume.name = name_of(data);
  scene.function.name = scene.volume.name;
  return scene;
}

}  // namespace triptych::volume_suite
