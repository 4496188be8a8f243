// Stress scenes that test properties of the particle set, and of the image into which it is drawn.

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "core/random.hpp"
#include "scene/particle_generators.hpp"
#include "scene/particle_scene.hpp"
#include "suites/particles/stress_maker.hpp"
#include "suites/particles/stress_scenes.hpp"

namespace triptych::particles_suite {
namespace {

constexpr double fov = 60;

StressScene generated(std::string_view generator, std::uint64_t count, scene::ColourKind colour,
                      int width, int height) {
  scene::ParticleSet set = scene::generate_particles(generator, count, colour);
  const scene::Camera camera = scene::particle_camera("orbit_y:1/8", set, fov);
  return stress_of(std::move(set), camera, width, height);
}

// Shuffles the particles together with their ids and colours (Fisher and Yates 1938).
void shuffle(scene::ParticleSet& set) {
  core::Random random(5);
  const auto exchange = [](auto& values, std::size_t i, std::size_t j) {
    if (!values.empty()) std::swap(values[i], values[j]);
  };
  for (std::size_t i = set.count() - 1; i > 0; --i) {
    const std::size_t j = random.bits() % (i + 1);
    exchange(set.spheres, i, j);
    exchange(set.ids, i, j);
    exchange(set.rgba8, i, j);
    exchange(set.rgba32, i, j);
    exchange(set.intensity, i, j);
  }
}

}  // namespace

StressScene stress_no_sphere(std::string_view variant, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at({0, 0, 4}, {0, 0, 0}, fov), stress_side, stress_side);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const glm::dvec3 before{0, 0, 0.5};
  maker.add({0, 0, 0}, 1);
  if (variant == "vanishing") {
    // These radii are finite and positive, although their squares are 0 in single precision. The
    // last radius is subnormal.
    maker.add(maker.place(48.5, 48.5, 2), 1e-25);
    maker.add(maker.place(30.5, 40.5, 2), 1e-30);
    maker.add(maker.place(50.5, 30.5, 2), 1e-40);
  } else if (variant == "with") {
    for (const double radius : {0.0, -1.0, nan, infinity, -infinity}) maker.add(before, radius);
    for (const double place : {nan, infinity, -infinity}) maker.add({place, 0, 0.5}, 1);
    maker.add({0, nan, 0.5}, 1);
    maker.add({0, 0, nan}, 1);
  } else {
    for (int dropped = 0; dropped < 10; ++dropped) maker.skip();
  }
  maker.add({1, 0, 0.5}, 0.7);
  return maker.take();
}

// Five spheres, each of which is added eight times. Equal spheres are far apart in the set.
StressScene stress_coincident(std::string_view, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at({1, 0.7, 4}, {0, 0, 0}, fov), stress_side,
                    stress_side);
  for (int copy = 0; copy < 8; ++copy) {
    maker.add({0, 0, 0}, 0.9);
    maker.add({1.1, 0.6, 0.2}, 0.5);
    maker.add({-1.1, 0.5, 0.1}, 0.6);
    maker.add({0.2, -1.2, -0.3}, 0.7);
    maker.add({0.1, 0.1, -3}, 2);
  }
  return maker.take();
}

// A cubic lattice whose spacing equals the radius. Each inner sphere intersects 26 others. Its
// visible part is bounded by the planes in which it intersects its neighbours.
StressScene stress_interpenetrating(std::string_view, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at({3, 2.2, 4.1}, {0, 0, 0}, 45), stress_side,
                    stress_side);
  for (int z = 0; z < 4; ++z) {
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) maker.add(0.5 * glm::dvec3{x, y, z} - 0.75, 0.5);
    }
  }
  return maker.take();
}

// All particles cover the centre of one pixel. The particle that is added last hides all others
// there.
StressScene stress_pile(std::string_view variant, scene::ColourKind colour) {
  constexpr int small_side = 33;
  const std::uint64_t count = number_in<std::uint64_t>(variant);
  StressMaker maker(colour, camera_looking_at({0, 0, 0}, {0, 0, -1}, fov), small_side, small_side);
  core::Random random(7);
  const auto jittered = [&] { return small_side / 2.0 + random.uniform(-0.2, 0.2); };
  for (std::uint64_t i = 0; i + 1 < count; ++i) {
    const double x = jittered();
    const double y = jittered();
    maker.add_at(x, y, random.uniform(4, 5), 0.6);
  }
  maker.add_at(small_side / 2.0, small_side / 2.0, 3.9, 0.6);
  return maker.take();
}

StressScene stress_count(std::string_view variant, scene::ColourKind colour) {
  const std::uint64_t count = number_in<std::uint64_t>(variant);
  if (count > 0) return generated("uniform", count, colour, stress_side, stress_side);
  return StressMaker(colour, camera_looking_at({0, 0, 3}, {0, 0, 0}, fov), stress_side, stress_side)
      .take();
}

StressScene stress_order(std::string_view variant, scene::ColourKind colour) {
  StressScene scene = generated("coincident", 3000, colour, stress_side, stress_side);
  if (variant == "shuffled") shuffle(scene.particles);
  return scene;
}

// There is a crowd of spheres on each side of a wall. The eye jumps from one side to the other. The
// visibility in the previous frame is therefore useless, and most spheres that were hidden have
// become visible.
StressScene stress_jump(std::string_view, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at({3, 2, -24}, {0, 0, 0}, fov), stress_side,
                    stress_side);
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 21; ++x) maker.add({x - 10.0, y - 10.0, 0}, 0.75);
  }
  core::Random random(3);
  for (int i = 0; i < 15000; ++i) {
    for (const double before : {-1.0, 1.0}) {
      const double x = random.uniform(-8, 8);
      const double y = random.uniform(-8, 8);
      maker.add({x, y, before * random.uniform(1, 6)}, 0.12);
    }
  }
  StressScene scene = maker.take();
  scene.camera_before = camera_looking_at({0, 0, 24}, {0, 0, 0}, fov);
  scene.camera_before->near =
      scene::depth_scale(scene::bounding_box(scene.particles), scene.camera_before->eye);
  return scene;
}

// Images of different shapes, such as "64x48". Along its longer side, each image shows the same
// extent of the scene.
StressScene stress_shape(std::string_view variant, scene::ColourKind colour) {
  const std::size_t times = variant.find('x');
  const int width = number_in<int>(variant.substr(0, times));
  const int height = number_in<int>(variant.substr(times + 1));
  StressScene scene = generated("uniform", 2000, colour, width, height);
  if (width > height) {
    const double half = std::tan(fov * std::numbers::pi / 360) * height / width;
    scene.camera.fov_y_deg = 2 * std::atan(half) * 180 / std::numbers::pi;
  }
  return scene;
}

// From its left to its right edge, the image spans 90 degrees.
StressScene stress_widest(std::string_view, scene::ColourKind colour) {
  constexpr int width = 16384;
  constexpr int height = 8;
  const double degrees = 2 * std::atan(1.0 * height / width) * 180 / std::numbers::pi;
  StressMaker maker(colour, camera_looking_at({0, 0, 0}, {0.2, 0.1, -1}, degrees), width, height);
  core::Random random(9);
  for (int i = 0; i < 2000; ++i) {
    const double x = random.uniform(0, width);
    const double y = random.uniform(-2, height + 2.0);
    maker.add_at(x, y, random.uniform(1, 9), random.uniform(2, 12));
  }
  return maker.take();
}

StressScene stress_field_of_view(std::string_view variant, scene::ColourKind colour) {
  if (variant == "0.001") {
    StressMaker maker(colour, camera_looking_at(10.0 * oblique(), {0, 0, 0}, 0.001), stress_side,
                      stress_side);
    for (int i = 0; i < 5; ++i) maker.add_at(16 + 15.0 * i, 20 + 13.0 * i, 10, 6 + 2.0 * i);
    return maker.take();
  }
  // The image shows almost a half space, so spheres near its edges look large.
  const scene::Camera camera = camera_looking_at({0.1, 0.2, 0.3}, {0.4, 0.1, -2}, 179);
  StressMaker maker(colour, camera, stress_side, stress_side);
  for (int i = 0; i < 8; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.3) / 8;
    const glm::dvec3 sideways = std::cos(angle) * camera.right() + std::sin(angle) * camera.up;
    maker.add(camera.eye + (10.0 + i) * (0.08 * camera.forward + sideways), 0.7 + 0.05 * i);
  }
  maker.add(camera.eye + 10.0 * camera.forward, 9.5);
  return maker.take();
}

// The letter F, with its lower end closer to the eye, so that every flip and every exchange of axes
// changes the image.
StressScene stress_asymmetric(std::string_view, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at({0, 0, 0}, {0, 0, -1}, fov), stress_side,
                    stress_side);
  for (int i = 0; i < 7; ++i) maker.add_at(30, 16 + 10.0 * i, 5 - 0.3 * i, 7);
  for (int i = 1; i < 4; ++i) maker.add_at(30 + 11.0 * i, 16, 5 + 0.2 * i, 6);
  for (int i = 1; i < 3; ++i) maker.add_at(30 + 11.0 * i, 45, 4 + 0.2 * i, 5);
  return maker.take();
}

}  // namespace triptych::particles_suite
