#include "technique/particles/option_reason.hpp"

#include <gmock/gmock.h>

#include <array>

namespace triptych::technique {
namespace {

using testing::HasSubstr;

constexpr std::array<std::string_view, 8> techniques{
    "quad_screen",  "quad_ray",         "quad_instanced", "quad_tess",
    "polygon_tess", "polygon_adaptive", "point",          "tiles"};
constexpr std::array all_rasterizers{SpriteRasterizer::api, SpriteRasterizer::tiles};

std::string reason(std::string_view technique, const ParticleOptions& options,
                   SpriteRasterizer rasterizer = SpriteRasterizer::api) {
  return option_reason(technique, options, rasterizer).value_or("");
}

TEST(OptionReason, WithoutFaultsOnlyRaysAndCornersAreRejected) {
  for (const std::string_view technique : techniques) {
    for (const SpriteRasterizer rasterizer : all_rasterizers) {
      for (const Culling culling : {Culling::none, Culling::frustum, Culling::occlusion}) {
        for (const bool conservative : {false, true}) {
          EXPECT_EQ(reason(technique, {.conservative_depth = conservative, .culling = culling},
                           rasterizer),
                    "")
              << technique;
        }
      }
    }
  }
}

TEST(OptionReason, RaysAtVerticesNeedVertices) {
  for (const std::string_view technique : techniques) {
    for (const SpriteRasterizer rasterizer : all_rasterizers) {
      const bool refused = technique == "point" || technique == "tiles";
      EXPECT_EQ(reason(technique, {.ray = ComputedAt::vertex}, rasterizer).empty(), !refused)
          << technique;
    }
  }
  EXPECT_THAT(reason("point", {.ray = ComputedAt::vertex}), HasSubstr("one vertex"));
  EXPECT_THAT(reason("tiles", {.ray = ComputedAt::vertex}), HasSubstr("no vertices"));
  EXPECT_THAT(reason("bvh", {.ray = ComputedAt::vertex}), HasSubstr("no vertices"));
}

TEST(OptionReason, APolygonHasAtLeastFourCorners) {
  EXPECT_THAT(reason("polygon_tess", {.corners = 3}), HasSubstr("corners=3"));
  EXPECT_EQ(reason("polygon_tess", {.corners = 4}), "");
  // The adaptive technique ignores the number of corners.
  EXPECT_EQ(reason("polygon_adaptive", {.corners = 3}), "");
}

TEST(OptionReason, AFaultNeedsTheCodeThatItBreaks) {
  for (const std::string_view technique : techniques) {
    for (const SpriteRasterizer rasterizer : all_rasterizers) {
      const auto refused = [&](const ParticleOptions& options) {
        return !reason(technique, options, rasterizer).empty();
      };
      const bool tiles = technique == "tiles";
      for (const ParticleFault everywhere :
           {ParticleFault::small_sprite, ParticleFault::unresolved_ties,
            ParticleFault::reversed_depth, ParticleFault::culled_visible}) {
        EXPECT_FALSE(refused({.fault = everywhere})) << technique;
      }
      EXPECT_TRUE(refused({.culling = Culling::none, .fault = ParticleFault::culled_visible}));
      EXPECT_EQ(refused({.fault = ParticleFault::wrong_sense}), !tiles) << technique;
      EXPECT_FALSE(refused({.conservative_depth = true, .fault = ParticleFault::wrong_sense}));
      const bool in_tiles = tiles || rasterizer == SpriteRasterizer::tiles;
      EXPECT_EQ(refused({.fault = ParticleFault::lost_at_border}), !in_tiles) << technique;
      EXPECT_EQ(refused({.fault = ParticleFault::missing_barrier}),
                rasterizer != SpriteRasterizer::tiles)
          << technique;
    }
  }
}

TEST(OptionReason, OnlyRaysHaveAStructureToBuild) {
  for (const Structure structure : {Structure::refitted, Structure::rebuilt}) {
    for (const std::string_view technique : techniques) {
      EXPECT_THAT(reason(technique, {.structure = structure}), HasSubstr("no hierarchy"));
    }
    EXPECT_EQ(reason("bvh", {.structure = structure}), "");
    EXPECT_EQ(reason("ray_query", {.structure = structure}), "");
  }
}

TEST(OptionReason, RaysHaveTheFaultsOfBoxesAndDepths) {
  const auto refused = [](ParticleFault fault) {
    return !reason("bvh", {.conservative_depth = true, .fault = fault}).empty();
  };
  for (const ParticleFault fault :
       {ParticleFault::small_box, ParticleFault::wrong_sense, ParticleFault::unresolved_ties,
        ParticleFault::reversed_depth}) {
    EXPECT_FALSE(refused(fault));
  }
  for (const ParticleFault fault :
       {ParticleFault::small_sprite, ParticleFault::culled_visible, ParticleFault::lost_at_border,
        ParticleFault::missing_barrier}) {
    EXPECT_TRUE(refused(fault));
  }
  EXPECT_THAT(reason("tiles", {.fault = ParticleFault::small_box}), HasSubstr("boxes"));
}

}  // namespace
}  // namespace triptych::technique
