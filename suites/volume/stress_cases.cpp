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
       "the eye is inside the volume, also on a voxel's centre",
       "rays begin at the eye: the slab's entry is behind it and 0 is taken instead",
       {"middle", "voxel"},
       stress_inside},
      {2,
       "boundary",
       "the eye is on a face, an edge, a corner; on a face looking away",
       "the entry is at 0 for rays inward; looking away, no ray has a length and all is background",
       {"face", "edge", "corner", "away"},
       stress_boundary},
      {3,
       "parallel",
       "directions with a component of ±0 whose rays begin on the slab's plane",
       "no 0·∞: such a ray is in the slab for all of its length or for none of it, and the bound "
       "knows that rounding decides which",
       {"lower", "upper", "negative_zero"},
       stress_parallel},
      {4,
       "within_face",
       "rays that lie in a face, and one that lies in an edge",
       "as above: finite, and of those rays whatever lies between none and all of their length",
       {"face", "edge"},
       stress_within_face},
      {5,
       "chord",
       "rays that cut an edge or a corner off, so that their chords tend to 0",
       "opacity falls with the chord to 0: 1 − (1 − α)^s without cancellation, no sample where "
       "there is no length",
       {"edge", "corner"},
       stress_chord},
      {6,
       "octant",
       "volume and camera mirrored into all eight octants",
       "mirror images of the first within both bounds; not to the bit, for N − x and x round "
       "differently",
       {"ppp", "mpp", "pmp", "mmp", "ppm", "mpm", "pmm", "mmm"},
       stress_octant},
      {7,
       "far",
       "the eye is 10³ … 10⁷ voxels away, its lens as long; the volume begins at 0 by "
       "definition, so that a world offset is one of the eye alone",
       "the picture from near by: rays begin on a plane before the box, whose place is found in "
       "double precision, so that nothing of the way there is left to round",
       {"1e3", "1e4", "1e5", "1e6", "1e7"},
       stress_far},
  };
}

std::vector<StressCase> cases_of_size() {
  return {
      {8,
       "scale",
       "world units of 2^±20, extinction the inverse",
       "the bits of scale 1: a power of two rounds nothing, and no threshold is in world units",
       {"one", "up", "down"},
       stress_scale},
      {9,
       "spacing",
       "voxels of 1:1:8 and 1:1:1000",
       "within a bound that counts lengths in the smallest spacing, in which a direction's "
       "rounding moves a sample",
       {"8", "1000"},
       stress_spacing},
      {10,
       "slice",
       "one voxel thick along x, y or z",
       "constant along that axis by clamping to the edge: two equal neighbours interpolate to "
       "themselves",
       {"x", "y", "z"},
       stress_slice},
      {11, "tiny", "1×1×1 and 2×2×2 voxels", "as above, on all axes", {"1", "2"}, stress_tiny},
      {12,
       "prime",
       "13×31×17 voxels: no size is a multiple of a brick, a work-group, an alignment",
       "rows are where they are said to be, and the last bricks hold what is left",
       {},
       stress_prime},
      {13,
       "oversize",
       "20000 voxels along x, above every limit of a texture",
       "drawn by whoever reads voxels from a buffer, refused with both numbers by all else",
       {},
       stress_oversize},
      {14,
       "unseen",
       "the volume is behind the eye, or beside the frustum",
       "no samples, background to the bit",
       {"behind", "beside"},
       stress_unseen},
  };
}

std::vector<StressCase> cases_of_voxels() {
  return {
      {15,
       "format",
       "one field in 8, 16 and 32 bits",
       "one picture within both bounds: 255 and 65535 are mapped to 1 exactly",
       {"f32", "u8", "u16"},
       stress_format},
      {16,
       "nan",
       "voxels that are NaN: one, a block, every second, one under shading",
       "the bits of a field that holds 0 there, where the function is transparent: NaN is taken "
       "out when voxels are prepared and reaches no device",
       {"zero_one", "nan_one", "zero_block", "nan_block", "zero_mesh", "nan_mesh", "zero_shaded",
        "nan_shaded"},
       stress_nan},
      {17,
       "infinite",
       "voxels of ±∞",
       "the bits of a field that holds the ends of the range there",
       {"upper", "plus", "lower", "minus"},
       stress_infinite},
      {18,
       "denormal",
       "denormal voxels, opacities, colours, transmittances",
       "0 before they reach a device; those that a ray makes are kept or taken for 0, which "
       "changes nothing by more than 2⁻¹²⁶; in at most 1.2 of the time "
       "(tests/contract/stress_test.cpp)",
       {"voxels", "opacity", "colour", "transmittance"},
       stress_denormal},
      {19,
       "flat",
       "the range is empty, of floats and of bytes; the field is constant, shaded too",
       "an empty range maps all to 0; where the gradient is 0, so is its cosine, by the floor "
       "under the division",
       {"range_f32", "range_u8", "plain", "shaded"},
       stress_flat},
  };
}

std::vector<StressCase> cases_of_transfer() {
  return {
      {20,
       "solid",
       "opacity exactly 1",
       "1 − (1 − 1)^s is 1 and not NaN: one colour to the bit",
       {},
       stress_solid},
      {21,
       "nearly_solid",
       "opacity 1 − 2⁻²⁴, the largest below 1",
       "1 − α is exact, so that every form of the correction keeps its bound",
       {"root", "square", "any"},
       stress_nearly_solid},
      {22,
       "faint",
       "100,000 samples of opacity 2⁻²⁰",
       "1 − (1 − 2⁻²⁰)^100000 = 0.091 along the cube, within 4u for each sample",
       {},
       stress_faint},
      {23,
       "march",
       "100,000 and 1,000,000 steps through a varying field",
       "samples stand at (i + ½)·h, i exact up to 2²³, so that none drifts; 4u for each sample",
       {"1e5", "1e6"},
       stress_march},
      {24,
       "stride",
       "a step twice and a thousand times the volume's diagonal",
       "one partial sample of the whole chord, with the value that the edge is clamped to",
       {"twice", "thousand"},
       stress_stride},
      {25,
       "spike",
       "one visible entry of 256, at a step that can miss it",
       "the truth's samples hit and miss alike; where rounding may decide, the bound holds both; "
       "pre-integrated, no step misses it",
       {"low", "middle", "preintegrated"},
       stress_spike},
      {26,
       "end_spike",
       "only the first or the last entry is visible",
       "half an entry beyond its centre has its colour; skipping must not take the end for empty",
       {"first", "last"},
       stress_end_spike},
      {27,
       "slope",
       "opacity linear along rays, its slope down to ±1e-7 and 0",
       "pre-integrated steps without cancellation as the slope vanishes",
       {"0.03", "1e-4", "1e-7", "0", "-1e-7", "-0.03"},
       stress_slope},
      {28,
       "edit",
       "random functions, with runs of visible entries (100 of them in "
       "tests/contract/stress_test.cpp)",
       "skipping changes no bit, whatever the function",
       {"1", "2", "3", "4", "5", "6", "7", "8"},
       stress_edit},
      {29,
       "transparent",
       "a function without any opacity",
       "background to the bit; no sample where space is leapt over, one per ray at most by a walk",
       {},
       stress_transparent},
      {30,
       "opaque",
       "full opacity, rays end early",
       "at most two samples per ray",
       {},
       stress_opaque},
      {31,
       "lit_everywhere",
       "one lit voxel in each brick: nothing can be skipped",
       "at most 1.1 of the samples without skipping",
       {},
       stress_lit_everywhere},
      {32,
       "lit",
       "a lit voxel on a brick's face, edge, corner, in the first and the last layer",
       "it is seen: a brick's border of one voxel reaches it from every sample",
       {"face", "edge", "corner", "first", "last"},
       stress_lit},
  };
}

std::vector<StressCase> cases_of_frame() {
  return {
      {51,
       "shape",
       "1×1, 1×13, 17×1 and 17×13 pixels",
       "parts of the largest within both bounds: pixels of incomplete work-groups are drawn, "
       "others are not",
       {"17x13", "1x1", "1x13", "17x1"},
       stress_shape},
      {52,
       "widest",
       "16384 pixels in a row, and one more",
       "drawn; the longer row may be refused with both numbers",
       {"16384", "16385"},
       stress_widest},
      {53,
       "field_of_view",
       "0.001° and 179°",
       "within the bound: a direction is a sum of three products whatever the angle",
       {"narrowest", "widest"},
       stress_field_of_view},
      {54,
       "asymmetric",
       "a scene without symmetry, as large upright as across",
       "the truth, from which every flip of it differs by far more than the bound",
       {},
       stress_asymmetric},
      {56,
       "halves",
       "integers to 65504, the largest half; to 65535, beyond it; floats that would be subnormal",
       "voxels of f16: the first exact, the second over their range, no half subnormal, none "
       "infinite",
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
