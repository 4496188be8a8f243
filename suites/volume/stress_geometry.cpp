// Stress cases 1 to 7 and 14 of the catalogue in docs/accuracy.md, which test positions of the eye
// and directions of rays.

#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "suites/volume/stress_parts.hpp"
#include "suites/volume/stress_scenes.hpp"

namespace triptych::volume_suite {
namespace {

constexpr int edge = 24;  // size of asymmetric_scene in voxels

StressScene seen_from(const scene::Camera& camera) {
  StressScene scene = asymmetric_scene();
  scene.camera = camera;
  return scene;
}

// Makes the numbers of columns and rows odd, so that the ray in the middle points exactly forward.
StressScene with_middle_ray(StressScene scene) {
  scene.width = scene.height = 25;
  return scene;
}

// Returns 2·atan(half/distance) in degrees, so that the image shows `half` to either side at that
// distance.
double fov_of(double half, double distance) {
  return 2 * std::atan2(half, distance) * 180 / std::numbers::pi;
}

}  // namespace

StressScene stress_inside(std::string_view variant) {
  const glm::dvec3 middle(edge / 2.0);
  if (variant == "voxel") return seen_from(camera_looking_at({7.5, 15.5, 9.5}, {20, 3, 17}, 90));
  return seen_from(camera_looking_at(middle, middle + glm::dvec3(-1, 0.4, -0.7), 100));
}

StressScene stress_boundary(std::string_view variant) {
  if (variant == "face") return seen_from(camera_looking_at({0, 9.25, 13.5}, {12, 12, 12}, 90));
  if (variant == "edge") return seen_from(camera_looking_at({edge, edge, 10.25}, {12, 12, 12}, 90));
  if (variant == "corner") return seen_from(camera_looking_at({0, edge, edge}, {12, 12, 12}, 90));
  // The eye is on a face and looks outward, in such a direction that no ray enters the volume.
  StressScene scene = seen_from(camera_looking_at({edge, 9.25, 13.5}, {40, 12, 12}, 60));
  scene.expectations = {{"exactly the background, because no ray enters the box",
                         record::UniformColour{scene.background}}};
  return scene;
}

StressScene stress_parallel(std::string_view variant) {
  // The rays of the middle column of pixels have directions with x = ±0, and lie in the plane x = 0
  // or x = 24, which contains a face of the volume.
  if (variant == "lower") {
    return with_middle_ray(seen_from(along({0, 11, 40}, {0, 0, -1}, {0, 1, 0}, 45)));
  }
  if (variant == "upper") {
    return with_middle_ray(seen_from(along({edge, 11, 40}, {0, 0, -1}, {0, 1, 0}, 45)));
  }
  return with_middle_ray(seen_from(along({0, 0, -16}, {-0.0, -0.0, 1}, {-0.0, 1, 0}, 45)));
}

StressScene stress_within_face(std::string_view variant) {
  const double y = edge;
  if (variant == "face") {
    return with_middle_ray(seen_from(along({-9, y, 10.5}, {1, 0, 0}, {0, 1, 0}, 70)));
  }
  return with_middle_ray(seen_from(along({-9, y, edge}, {1, 0, 0}, {0, 1, 0}, 70)));
}

// The image is 0.04 voxels wide, and shows an edge or a corner of the volume (`edge`, `corner`).
// The chord of a ray tends to 0 as the ray approaches this edge or corner. The field has no zeros,
// so that even the shortest chord is visible.
StressScene stress_chord(std::string_view variant) {
  StressScene scene = asymmetric_scene();
  scene.function = uniform({0.75F, 0.5F, 0.25F, 0.9999F});
  scene.step_voxels = 0.25;
  const bool at_edge = variant == "edge";
  const glm::dvec3 target = at_edge ? glm::dvec3(0, 0, 11.25) : glm::dvec3(0, 0, 0);
  // The camera looks past the edge or corner from outside, where rays graze the box.
  const glm::dvec3 from = at_edge ? glm::dvec3(40, -40, 3) : glm::dvec3(30, -33, 4);
  scene.camera = camera_looking_at(target + from, target, fov_of(0.02, glm::length(from)));
  return scene;
}

// The field and the camera are mirrored along the axes that are marked `m` in the variant's name.
// An odd number of reflections mirrors the image horizontally, because the camera's axes are
// right-handed; an even number does not.
StressScene stress_octant(std::string_view variant) {
  const glm::dvec3 sign(variant[0] == 'm' ? -1 : 1, variant[1] == 'm' ? -1 : 1,
                        variant[2] == 'm' ? -1 : 1);
  const Size size{edge, edge, edge};
  const auto at = [&](int index, int axis) { return sign[axis] < 0 ? edge - 1 - index : index; };
  StressScene scene = seen_from_outside(volume_of(size, [&](int i, int j, int k) {
    return asymmetric_value(size, at(i, 0), at(j, 1), at(k, 2));
  }));
  // The coordinates need only a few bits, so that the mirrored eye is exact.
  const scene::Camera plain = camera_looking_at(glm::dvec3(20, 13, 27), {0, 0, 0}, 50);
  scene.camera = along(glm::dvec3(edge / 2.0) + sign * plain.eye, sign * plain.forward,
                       sign * plain.up, plain.fov_y_deg);
  if (variant != "ppp") {
    scene.expectations = {
        {sign.x * sign.y * sign.z < 0
             ? "the horizontally mirrored image of the scene stress:octant:ppp, within the sum of "
               "both error bounds"
             : "the image of the scene stress:octant:ppp, within the sum of both error bounds",
         record::SameImage{.changed = {{"data", "stress:octant:ppp"}},
                           .mirrored_x = sign.x * sign.y * sign.z < 0,
                           .bit_identical = false}}};
  }
  return scene;
}

// The volume appears at the same size from every distance, because the focal length is proportional
// to the distance.
StressScene stress_far(std::string_view variant) {
  double distance = 0;
  std::from_chars(variant.data(), variant.data() + variant.size(), distance);
  StressScene scene = asymmetric_scene();
  const glm::dvec3 middle(edge / 2.0);
  scene.camera = camera_looking_at(middle + distance * glm::dvec3(0.48, 0.36, 0.8), middle,
                                   fov_of(0.9 * edge, distance));
  return scene;
}

StressScene stress_unseen(std::string_view variant) {
  const glm::dvec3 eye(60, 12, 70);
  StressScene scene = seen_from(variant == "behind" ? camera_looking_at(eye, eye + eye, 60)
                                                    : camera_looking_at(eye, {140, 12, 70}, 60));
  const record::Expectation none{"no sample, because no ray hits the box",
                                 record::CountAtMost{.counter = "samples", .factor = 0}};
  const record::Expectation background{"exactly the background",
                                       record::UniformColour{scene.background}};
  scene.expectations = {none, background};
  return scene;
}

}  // namespace triptych::volume_suite
