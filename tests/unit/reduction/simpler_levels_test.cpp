// Tests which simpler levels are tried in place of each level.

#include "reduction/simpler_levels.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "measure/contract/factor.hpp"

namespace triptych::reduction {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr auto of_the_image = measure::FactorRole::scene;

TEST(SimplerLevels, AChoiceHasThePrecedingLevels) {
  const measure::Factor skip =
      measure::choice("skip", {"none", "bricks", "distance"}, "distance", of_the_image, "");
  EXPECT_THAT(simpler_levels(skip, "distance"), ElementsAre("none", "bricks"));
  EXPECT_THAT(simpler_levels(skip, "none"), IsEmpty());
}

TEST(SimplerLevels, ANumberIsTurnedOffOrHasItsDefault) {
  const measure::Factor ert = measure::number("ert", 0, 0.5, "0.001953125", of_the_image, "");
  EXPECT_THAT(simpler_levels(ert, "0.1"), ElementsAre("0", "0.001953125"));
  EXPECT_THAT(simpler_levels(ert, "0.001953125"), ElementsAre("0"));
  EXPECT_THAT(simpler_levels(ert, "0"), IsEmpty());
  const measure::Factor step = measure::number("step", 0.01, 16, "1", of_the_image, "");
  EXPECT_THAT(simpler_levels(step, "0.5"), ElementsAre("1"));
  EXPECT_THAT(simpler_levels(step, "1"), IsEmpty());
}

TEST(SimplerLevels, ATextHasItsDefault) {
  const measure::Factor camera = measure::text("camera", "orbit_y:1/8", "");
  EXPECT_THAT(simpler_levels(camera, "random:7"), ElementsAre("orbit_y:1/8"));
  EXPECT_THAT(simpler_levels(camera, "orbit_y:1/8"), IsEmpty());
}

TEST(SimplerLevels, AViewportShrinksAsAWholeThenBySides) {
  const measure::Factor viewport = measure::text("viewport", "256", "");
  EXPECT_THAT(simpler_levels(viewport, "4"),
              ElementsAre("1", "2", "3", "1x4", "2x4", "3x4", "4x1", "4x2", "4x3"));
  EXPECT_THAT(simpler_levels(viewport, "2x1"), ElementsAre("1", "1"));
  EXPECT_THAT(simpler_levels(viewport, "1"), IsEmpty());
}

TEST(SimplerLevels, SizesApproachFromBelow) {
  const measure::Factor viewport = measure::text("viewport", "256", "");
  const std::vector<std::string> levels = simpler_levels(viewport, "100");
  for (const char* level : {"1", "3", "64", "96", "88", "94", "99"}) {
    EXPECT_THAT(levels, Contains(level));
  }
  EXPECT_THAT(levels, Not(Contains("100")));
  EXPECT_LT(levels.size(), 70U);
}

TEST(SimplerLevels, GeneratedDataShrinkAndFilesBecomeTheDefault) {
  const measure::Factor data = measure::text("data", "generate:mandelbulb:96", "");
  EXPECT_THAT(simpler_levels(data, "generate:ball:2"),
              ElementsAre("generate:ball:1", "generate:ball:1x2x2", "generate:ball:2x1x2",
                          "generate:ball:2x2x1"));
  EXPECT_THAT(simpler_levels(data, "head.nrrd"), ElementsAre("generate:mandelbulb:96"));
}

}  // namespace
}  // namespace triptych::reduction
