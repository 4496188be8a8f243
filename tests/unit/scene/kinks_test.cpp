#include "scene/kinks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace triptych::scene {
namespace {

std::ptrdiff_t count(const TransferFunction& function) {
  return std::ranges::count(kinks(function), true);
}

// A control point between two entries causes two kinks, and a control point at an entry causes one.
// Where the function is transparent, there are no kinks.
TEST(Kinks, OfAPresetAreItsControlPoints) {
  EXPECT_EQ(count(load_transfer_function("surfaces")), 21);
  const auto found = kinks(load_transfer_function("haze"));
  EXPECT_FALSE(found[16]) << "a colour kink in a transparent range must not count";
  EXPECT_TRUE(found[31] || found[32]) << "the beginning of the opacity ramp";
}

TEST(Kinks, AStraightFunctionHasThemAtItsEndsOnly) {
  TransferFunction function;
  for (std::size_t k = 0; k < 256; ++k) {
    const auto x = static_cast<float>(k) / 256;
    function.entries[k] = {x, 1 - x, 0.5F, 0.25F + x / 2};
  }
  const auto found = kinks(function);
  EXPECT_TRUE(found[0]);
  EXPECT_TRUE(found[255]);
  EXPECT_EQ(count(function), 2);
}

TEST(Kinks, ChangesOfNearlyTransparentColoursAreNotKinks) {
  TransferFunction function;
  for (std::size_t k = 0; k < 256; ++k) function.entries[k] = {k < 128 ? 0.0F : 1.0F, 0, 0, 1e-6F};
  EXPECT_EQ(count(function), 0);
  for (auto& entry : function.entries) entry[3] = 0.5F;
  EXPECT_EQ(count(function), 2);
}

}  // namespace
}  // namespace triptych::scene
