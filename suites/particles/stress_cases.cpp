#include "suites/particles/stress_cases.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "suites/particles/stress_scenes.hpp"

namespace triptych::particles_suite {
namespace {

struct Entry {
  StressCase info;
  MakeStressScene make;
};

// clang-format off
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {{33, "scale", "one scene is drawn with radii around 2^-20, 1 and 2^20",
        "colours and ids are bit-identical, because every value is a product, sum, quotient or "
        "square root of values that are scaled by the same power of two, and no square leaves the range "
        "of floats for radii from 2^-50 to 2^50",
        {"unit", "small", "large"}}, stress_scale},
      {{34, "far", "the eye is 10^3 to 2*10^5 radii from the sphere, whose silhouette is half as high as "
        "the image",
        "the silhouette of a sphere with radius r at distance d is accurate to within 8u times the "
        "image's side plus 5u*r (u = 2^-24), because the distance of a ray from the centre is computed "
        "with a cross product, whose rounding error in pixels does not depend on d (the usual "
        "discriminant would have an error of u*d^2, which exceeds r^2 beyond 4,096 radii). The depth has "
        "an error of up to 24u(d + r), which is 0.3 radii in the last variant",
        {"1e3", "1e4", "1e5", "2e5"}}, stress_far},
      {{35, "giant", "small spheres touch a sphere with 10,000 times their radius",
        "each sphere is within its own error bounds; the giant's larger bounds apply only to the "
        "giant's pixels",
        {}}, stress_giant},
      {{36, "inside", "the eye is inside a sphere: at its centre, off centre, or just below the "
        "surface",
        "every pixel shows the point where the ray leaves the sphere; everything outside is hidden",
        {"centre", "off_centre", "under_surface"}}, stress_inside},
      {{37, "skimming", "the eye is 1.0001 or 1.0006 radii from a sphere's centre, with the horizon in view",
        "if the eye is at most 1.0005 radii from the centre, the sprite covers the whole viewport; if "
        "the eye is farther away, the part of the sprite that is behind the eye is clipped; no pixel at the "
        "horizon (the edge of the visible part of the sphere) is lost",
        {"1.0001", "1.0006"}}, stress_skimming},
      {{38, "near_plane", "spheres cross the eye plane or come close to the eye",
        "the image has no holes, because the near plane does not clip any visible point; it only "
        "scales the reversed depth", {}}, stress_near_plane},
      {{39, "behind", "sphere centres are behind the eye plane, but part of each sphere is in front of "
        "it; one sphere is completely behind the plane",
        "the parts in front of the plane are visible, regardless of the sign of the centre's depth",
        {}}, stress_behind},
      {{40, "wide", "the field of view is 150 degrees, with spheres in the corners",
        "every sprite covers its sphere's whole elliptical silhouette, which is longest in the corners",
        {}}, stress_wide},
      {{41, "edges", "sphere centres are on the edges and corners of the image, and just outside the image",
        "the half or quarter of each sphere that is inside the image is visible; a sphere that ends "
        "one pixel outside the edge is not visible",
        {}}, stress_edges},
      {{42, "subpixel", "spheres have radii of 0.01 pixel and are centred on pixel centres or on pixel "
        "corners",
        "spheres on pixel centres are always visible, because their radius exceeds the tolerance "
        "of 1/256 pixel; spheres on pixel corners are never visible",
        {}}, stress_subpixel},
      {{43, "no_sphere", "radii are 0, negative, NaN or infinite; a centre is not finite; or the "
        "square of a radius underflows to 0",
        "invalid spheres are dropped and counted, and the image is bit-identical to the image without "
        "them; a sphere with a vanishing radius can change only pixels whose result depends on "
        "rounding",
        {"without", "with", "vanishing"}}, stress_no_sphere},
      {{44, "coincident", "each sphere occurs eight times, in different colours",
        "the sphere with the lowest id is visible everywhere, because coincident spheres have exactly "
        "equal depths, and the sphere that is drawn first stays visible", {}}, stress_coincident},
      {{45, "interpenetrating", "the spheres of a lattice intersect",
        "the boundaries between spheres lie in the bisecting planes, as in the closed-form solution",
        {}},
       stress_interpenetrating},
      {{46, "depth_range", "seven spheres, each ten times as far away as the one that overlaps it",
        "depths are ordered correctly over a range of 10^6, because reversed depth in floats has "
        "the same relative precision at all distances up to 2^24 times the scene's size", {}},
       stress_depth_range},
      {{47, "pile", "all particles cover the centre of one pixel, and the nearest particle is stored last",
        "the nearest particle is visible, and the frame ends within the time limit, because atomics "
        "or depth tests on one pixel take time at most proportional to the number of particles",
        {"200000", "10000000"}}, stress_pile},
      {{48, "count", "there are no particles, one particle, or about as many as fill a work group",
        "all particles are visible; without particles the image is the background",
        {"0", "1", "63", "64", "65", "513"}}, stress_count},
      {{49, "order", "the file stores the particles in a different order",
        "the image is bit-identical, because particles are arranged by position and id before drawing, "
        "and the id also breaks ties in depth",
        {"as_made", "shuffled"}}, stress_order},
      {{50, "jump", "the eye jumps to the other side of a wall and sees what the wall was hiding",
        "the first frame after the jump is correct with occlusion culling, because cells that were "
        "hidden in the previous frame are tested against the depths of this frame", {}}, stress_jump},
      {{51, "shape", "the image has one pixel, one row, one column, or incomplete tiles",
        "the image is within its error bounds", {"1x1", "1x40", "40x1", "17x13"}}, stress_shape},
      {{52, "widest", "the image has 16,384 by 8 pixels",
        "the image is within its error bounds, which allow a ray to be off by 8*2^-24 times the "
        "longer side (0.008 pixel); if the image exceeds a device limit, it is rejected with a message "
        "that states the image's size and the limit", {}},
       stress_widest},
      {{53, "field_of_view", "the field of view is 0.001 or 179 degrees",
        "centres are transformed to camera space with twice the precision of a float, so their error "
        "is 10^-8 pixel here",
        {"0.001", "179"}}, stress_field_of_view},
      {{54, "asymmetric", "the scene has no symmetry, so every flip would change its image",
        "the image has the same orientation with every API", {}}, stress_asymmetric},
  };
  return all;
}
// clang-format on

const Entry& entry_of(const StressData& data) {
  return *std::ranges::find(entries(), data.of->number,
                            [](const Entry& entry) { return entry.info.number; });
}

}  // namespace

const std::vector<StressCase>& stress_cases() {
  static const std::vector<StressCase> cases = [] {
    std::vector<StressCase> all;
    for (const Entry& entry : entries()) all.push_back(entry.info);
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
  const auto same_as_first = [&](std::string what, float depth_scale) {
    const StressData first{.of = data.of, .variant = data.of->variants.front()};
    return record::Expectation{
        std::move(what),
        record::SameImage{.changed = {{"data", name_of(first)}}, .depth_scale = depth_scale}};
  };
  if (name == "scale" && data.variant != "unit") {
    return {same_as_first(
        "the same image as with unit radii, and depths that are scaled like the radii",
        data.variant == "small" ? 0x1.0p-20F : 0x1.0p20F)};
  }
  if (name == "no_sphere" && data.variant == "with") {
    return {
        same_as_first("an image that is bit-identical to the image of the valid spheres alone", 1)};
  }
  if (name == "order" && data.variant == "shuffled") {
    return {same_as_first("a bit-identical image for any order of the particles in the file", 1)};
  }
  if (name == "count" && data.variant == "0") {
    return {{"only the background", record::UniformColour{{0, 0, 0, 0}}}};
  }
  if (name == "widest") {
    return {{"an image that a device may reject because it is too wide", record::MayBeRefused{}}};
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
