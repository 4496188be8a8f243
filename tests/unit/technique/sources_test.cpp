#include "technique/sources.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace triptych::technique {
namespace {

TEST(Sources, WholeHasWhatItIncludesInTheirPlace) {
  const std::string part(source("volume/raycast/walk.glsl"));
  const std::string line = "#include \"volume/raycast/walk.glsl\"\n";
  std::string expected(source("raycast.glsl"));
  const std::size_t place = expected.find(line);
  ASSERT_NE(place, std::string::npos);
  expected.replace(place, line.size(), part);
  EXPECT_EQ(whole_source("raycast.glsl"), expected);
}

TEST(Sources, WithoutIncludesItIsTheText) {
  EXPECT_EQ(whole_source("preintegrated.glsl"), source("preintegrated.glsl"));
  EXPECT_THROW(static_cast<void>(whole_source("no_such.glsl")), std::out_of_range);
}

}  // namespace
}  // namespace triptych::technique
