#include "technique/sources.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace triptych::technique {
namespace {

TEST(Sources, WholeHasWhatItIncludesInTheirPlace) {
  std::string expected(source("raycast.glsl"));
  for (const std::string name :
       {"volume/raycast/field.glsl", "volume/raycast/packed.glsl", "volume/raycast/walk.glsl",
        "volume/raycast/raycast_parts.glsl", "volume/raycast/pause.glsl"}) {
    const std::string line = "#include \"" + name + "\"\n";
    const std::size_t place = expected.find(line);
    ASSERT_NE(place, std::string::npos) << name;
    expected.replace(place, line.size(), source(name));
  }
  EXPECT_EQ(whole_source("raycast.glsl"), expected);
}

TEST(Sources, WithoutIncludesItIsTheText) {
  EXPECT_EQ(whole_source("preintegrated.glsl"), source("preintegrated.glsl"));
  EXPECT_THROW(static_cast<void>(whole_source("no_such.glsl")), std::out_of_range);
}

}  // namespace
}  // namespace triptych::technique
