#include "technique/particles/particle_parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/error.hpp"
#include "scene/particle_generators.hpp"

namespace triptych::technique {
namespace {

scene::ParticleScene small_scene() {
  scene::ParticleSet set = scene::generate_particles("uniform", 100, scene::ColourKind::rgba8);
  scene::ParticleScene scene;
  scene.camera = scene::particle_camera("random:4", set, 60);
  scene.particles = std::make_shared<const scene::ParticleSet>(std::move(set));
  scene.width = 320;
  scene.height = 200;
  return scene;
}

TEST(ParticleParameters, TwoFloatsStoreTheCameraToSixteenDigits) {
  const scene::ParticleScene scene = small_scene();
  const ParticleParameters p = particle_parameters(scene, {}, arrange(scene));
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const auto both = [&](const auto& nearest, const auto& rest) {
      return static_cast<double>(nearest[i]) + static_cast<double>(rest[i]);
    };
    EXPECT_NEAR(both(p.eye, p.eye_rest), scene.camera.eye[axis], 1e-13);
    EXPECT_NEAR(both(p.right, p.right_rest), scene.camera.right()[axis], 1e-14);
    EXPECT_NEAR(both(p.up, p.up_rest), scene.camera.up[axis], 1e-14);
    EXPECT_NEAR(both(p.forward, p.forward_rest), scene.camera.forward[axis], 1e-14);
  }
}

TEST(ParticleParameters, ThePlaneMatchesTheCamera) {
  const scene::ParticleScene scene = small_scene();
  const ParticleParameters p = particle_parameters(scene, {}, arrange(scene));
  const glm::dvec3 ray = scene.camera.ray_direction(31, 7, scene.width, scene.height);
  const double along = glm::dot(ray, scene.camera.forward);
  EXPECT_NEAR((31.5F * p.plane[2] - p.plane[0]), glm::dot(ray, scene.camera.right()) / along, 1e-6);
  EXPECT_NEAR((p.plane[1] - 7.5F * p.plane[3]), glm::dot(ray, scene.camera.up) / along, 1e-6);
}

TEST(ParticleParameters, DepthIsScaledByAPowerOfTwo) {
  const scene::ParticleScene scene = small_scene();
  int exponent = 0;
  EXPECT_EQ(std::frexp(scene.camera.near, &exponent), 0.5);
  EXPECT_GT(scene.camera.near, 0);
  EXPECT_LT(scene.camera.near, 1e-6);
}

TEST(ParticleOptions, NamesRoundTrip) {
  for (const Culling each : {Culling::none, Culling::frustum, Culling::occlusion}) {
    EXPECT_EQ(culling(name_of(each)), each);
  }
  for (const ComputedAt each : {ComputedAt::vertex, ComputedAt::pixel}) {
    EXPECT_EQ(computed_at(name_of(each)), each);
  }
  EXPECT_THROW(static_cast<void>(culling("some")), core::InputError);
  EXPECT_THROW(static_cast<void>(computed_at("fragment")), core::InputError);
}

}  // namespace
}  // namespace triptych::technique
