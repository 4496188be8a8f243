#include "measure/plan/plan_choice.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace triptych::measure {
namespace {

TEST(PlanChoice, ACommaBetweenValuesIsNoneWithin) {
  const Overrides overrides = PlanChoice{.set = {"step=0.5,1", "data=a%2Cb"}}.overrides();
  ASSERT_EQ(overrides.size(), 2U);
  EXPECT_EQ(overrides[0], (Overrides::value_type{"step", {"0.5", "1"}}));
  EXPECT_EQ(overrides[1], (Overrides::value_type{"data", {"a,b"}}));
  for (const char* text : {"step", "=1", "step="}) {
    EXPECT_THROW(static_cast<void>(PlanChoice{.set = {text}}.overrides()), core::InputError)
        << text;
  }
}

TEST(PlanChoice, APartIsOneOfThoseThereAre) {
  EXPECT_EQ(PlanChoice{}.part().count, 1);
  EXPECT_EQ(PlanChoice{.shard = "2/3"}.part().index, 2);
  for (const char* text : {"0/3", "4/3", "1", "1/", "1/2x", "x/2", "-1/2"}) {
    EXPECT_THROW(static_cast<void>(PlanChoice{.shard = text}.part()), core::InputError) << text;
  }
}

}  // namespace
}  // namespace triptych::measure
