// Tests which configurations are recognized as doing the same work in a particle scene.

#include "suites/particles/plain_work.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace triptych::particles_suite {
namespace {

measure::ParticleWork work_of(const std::vector<std::array<double, 4>>& spheres) {
  scene::ParticleSet set;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    if (scene::append(set, spheres[i], i)) set.rgba8.push_back(0xFFFFFFFFU);
  }
  measure::ParticleWork work;
  work.scene.particles = std::make_shared<const scene::ParticleSet>(std::move(set));
  work.scene.camera = scene::camera_looking_at({0, 0, 10}, {0, 0, 0}, 40);
  work.scene.width = 128;
  work.scene.height = 96;
  work.options.conservative_depth = true;
  return work;
}

const std::vector<std::array<double, 4>> apart{{-2, 0, 0, 0.4}, {2, 1, 0, 0.4}, {0, -2, 1, 0.3}};

measure::Configuration configuration(const std::string& technique, const std::string& colour) {
  return {{"technique", technique},          {"colour", colour}, {"transfer", "pixel"},
          {"transfer_function", "surfaces"}, {"corners", "16"},  {"conservative_depth", "on"}};
}

TEST(SpritesApart, OnlyWhereNoTwoShareAPixel) {
  EXPECT_TRUE(sprites_are_apart(work_of(apart).scene));
  EXPECT_TRUE(sprites_are_apart(work_of({}).scene));
  auto touching = apart;
  touching.push_back({2.5, 1, -3, 0.4});  // behind the second sphere, but beside it in the image
  EXPECT_FALSE(sprites_are_apart(work_of(touching).scene));
}

TEST(SpritesApart, SpheresAtTheEyeGiveNoResult) {
  auto near = apart;
  near.push_back({0, 0, 9.5, 0.4});
  EXPECT_FALSE(sprites_are_apart(work_of(near).scene));
  near.back() = {0, 0, 12, 0.4};  // completely behind the eye
  EXPECT_TRUE(sprites_are_apart(work_of(near).scene));
}

TEST(SpritesApart, UseTheDrawnRadius) {
  measure::ParticleWork work = work_of(apart);
  work.scene.radius_scale = 5;
  EXPECT_FALSE(sprites_are_apart(work.scene));
}

TEST(PlainParticleWork, UnusedLevelsBecomeDefaults) {
  const auto plain = plain_work(configuration("quad_ray", "rgba8"), work_of(apart));
  EXPECT_EQ(plain.levels.at("transfer"), "vertex");
  EXPECT_EQ(plain.levels.at("transfer_function"), "haze");
  EXPECT_EQ(plain.levels.at("corners"), "8");
  EXPECT_EQ(plain.levels.at("conservative_depth"), "off");
  EXPECT_EQ(plain.why.size(), 4U);
}

TEST(PlainParticleWork, UsedLevelsAreKept) {
  const auto plain = plain_work(configuration("polygon_tess", "intensity"),
                                work_of({{0, 0, 0, 1}, {0.5, 0, 0, 1}}));
  EXPECT_EQ(plain.levels, configuration("polygon_tess", "intensity"));
  EXPECT_TRUE(plain.why.empty());
}

TEST(PlainParticleWork, TilesIgnoreConservativeDepth) {
  const auto plain =
      plain_work(configuration("tiles", "intensity"), work_of({{0, 0, 0, 1}, {0.5, 0, 0, 1}}));
  EXPECT_EQ(plain.levels.at("conservative_depth"), "off");
}

}  // namespace
}  // namespace triptych::particles_suite
