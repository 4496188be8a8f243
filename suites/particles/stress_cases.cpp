#include "suites/particles/stress_cases.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "suites/particles/stress_scenes.hpp"

namespace triptych::particles_suite {
namespace {

struct Entry {
  StressCase of;
  MakeStressScene make;
};

// clang-format off
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {{33, "scale", "one scene with radii around 2^-20, 1 and 2^20",
        "the same colours and ids to the bit: every value is a product, sum, quotient or root of "
        "values times one power of two, and no square leaves the range of floats for radii from "
        "2^-50 to 2^50",
        {"unit", "small", "large"}}, stress_scale},
      {{34, "far", "an eye 10^3 to 2*10^5 radii away, the silhouette half as high as the picture",
        "the silhouette to 8u of the picture's side and 5u of the radius: no term of the cross "
        "product is larger than the picture at the sphere, whatever the distance; b^2 - c errs by "
        "u*d^2, more than r^2 from 4,096 radii on. Depth errs by 24u(d + r), 0.3 radii at the last",
        {"1e3", "1e4", "1e5", "2e5"}}, stress_far},
      {{35, "giant", "spheres on a neighbour of 10,000 of their radii",
        "each at its own bounds, which grow with the giant for the giant's pixels alone", {}},
       stress_giant},
      {{36, "inside", "the eye inside a sphere: in its centre, aside, just below the surface",
        "where the ray leaves the sphere, in every pixel; what lies outside is hidden",
        {"centre", "off_centre", "under_surface"}}, stress_inside},
      {{37, "skimming", "the eye 1.0001 and 1.0006 radii from a centre, the horizon in view",
        "a sprite of the whole viewport up to 1.0005 radii, beyond it one that reaches behind the "
        "eye and is clipped: no pixel is lost at the horizon",
        {"1.0001", "1.0006"}}, stress_skimming},
      {{38, "near_plane", "spheres across the plane of the eye and close to the eye itself",
        "no hole: nothing is clipped by a near plane that could be seen, as it only scales the "
        "reversed depth", {}}, stress_near_plane},
      {{39, "behind", "centres behind the eye's plane with a part in front, and one wholly behind",
        "the parts in front are seen, whatever sign the centre's depth has", {}}, stress_behind},
      {{40, "wide", "a field of view of 150 degrees with spheres in its corners",
        "ellipses 1/cos^2 as long as wide are covered to their ends by every sprite", {}},
       stress_wide},
      {{41, "edges", "centres on the edges and corners of the picture, and just outside",
        "the half or quarter inside is seen; what ends a pixel before the edge is not", {}},
       stress_edges},
      {{42, "subpixel", "radii of 0.01 pixel on the centres and on the corners of pixels",
        "those on centres show, certainly: 0.01 is more than the margin of 1/256; the others never",
        {}}, stress_subpixel},
      {{43, "no_sphere", "radius 0, negative, NaN or infinite, a centre that is no place; radii "
        "whose square is 0",
        "dropped and counted; the picture is that of the others alone to the bit; a vanishing "
        "radius changes no certain pixel", {"without", "with", "vanishing"}}, stress_no_sphere},
      {{44, "coincident", "every sphere eight times, in other colours",
        "the lowest id everywhere: equal spheres have equal depths to the bit, and the first in the "
        "order of drawing stays", {}}, stress_coincident},
      {{45, "interpenetrating", "a lattice of spheres that cut into each other",
        "boundaries in the bisecting planes (S4)", {}}, stress_interpenetrating},
      {{46, "depth_range", "seven spheres, each ten times as far away as the one that overlaps it",
        "the order of depths over a range of 10^6, as reversed depth in floats has one relative "
        "precision; it ends at 2^24 times the scene's size", {}}, stress_depth_range},
      {{47, "pile", "all particles over the centre of one pixel, the nearest last",
        "the nearest one, in time: atomics or the depth test on one pixel are no worse than linear",
        {"200000", "10000000"}}, stress_pile},
      {{48, "count", "no particle, one, and one less or more than a work group's worth",
        "all of them, and nothing but the background for none",
        {"0", "1", "63", "64", "65", "513"}}, stress_count},
      {{49, "order", "a file whose particles stand in another order",
        "the same bits: particles are arranged by place and id, and ties are decided by that",
        {"as_made", "shuffled"}}, stress_order},
      {{50, "jump", "an eye that jumps behind the wall that hid what it now sees",
        "the first frame after the jump is right with culling by occlusion: cells that the frame "
        "before did not show are tested against this frame's own depths", {}}, stress_jump},
      {{51, "shape", "pictures of one pixel, one row, one column, and of no whole tiles",
        "as ever", {"1x1", "1x40", "40x1", "17x13"}}, stress_shape},
      {{52, "widest", "a picture of 16,384 by 8 pixels",
        "drawn within the bounds, which allow 8u of the longer side: 0.008 pixel; what exceeds a "
        "device is refused with both numbers", {}}, stress_widest},
      {{53, "field_of_view", "a field of view of 0.001 and of 179 degrees",
        "centres carry twice a float's precision into camera space, 10^-8 of a pixel here",
        {"0.001", "179"}}, stress_field_of_view},
      {{54, "asymmetric", "a scene that no flip leaves as it is",
        "the same way up and round on every API", {}}, stress_asymmetric},
  };
  return all;
}
// clang-format on

const Entry& entry_of(const StressData& data) {
  return *std::ranges::find(entries(), data.of->number,
                            [](const Entry& entry) { return entry.of.number; });
}

}  // namespace

const std::vector<StressCase>& stress_cases() {
  static const std::vector<StressCase> cases = [] {
    std::vector<StressCase> all;
    for (const Entry& entry : entries()) all.push_back(entry.of);
    return all;
  }();
  return cases;
}

std::string name_of(const StressData& data) {
  return measure::stress_name(data);
}

std::optional<StressData> stress_data(std::string_view data) {
  return measure::choose_stress(data, stress_cases());
}

std::vector<record::Expectation> stress_expectations(const StressData& data) {
  const std::string_view name = data.of->name;
  const auto as_first = [&](std::string what, float depth_scale) {
    const StressData first{.of = data.of, .variant = data.of->variants.front()};
    return record::Expectation{
        std::move(what),
        record::SamePicture{.changed = {{"data", name_of(first)}}, .depth_scale = depth_scale}};
  };
  if (name == "scale" && data.variant != "unit") {
    return {as_first("the picture of unit radii to the bit, depths by a power of two",
                     data.variant == "small" ? 0x1.0p-20F : 0x1.0p20F)};
  }
  if (name == "no_sphere" && data.variant == "with") {
    return {as_first("the picture of the spheres alone to the bit", 1)};
  }
  if (name == "order" && data.variant == "shuffled") {
    return {as_first("the same bits in whatever order the file has its particles", 1)};
  }
  if (name == "count" && data.variant == "0") {
    return {{"the background alone", record::OneColour{{0, 0, 0, 0}}}};
  }
  if (name == "widest") {
    return {{"a picture as wide as devices may refuse", record::MayBeRefused{}}};
  }
  return {};
}

StressScene stress_scene(const StressData& data, scene::ColourKind colour) {
  StressScene scene = entry_of(data).make(data.variant, colour);
  scene.particles.name = name_of(data);
  scene.particles.hash = scene::particle_hash(scene.particles);
  return scene;
}

}  // namespace triptych::particles_suite
