#include "technique/sources.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace triptych::technique {
namespace {

TEST(Sources, WholeContainsTheIncludedFiles) {
  static constexpr std::string_view begin = "#include \"";
  std::string expected(source("raycast.glsl"));
  int included = 0;
  for (std::size_t at = 0; (at = expected.find(begin)) != std::string::npos; ++included) {
    const std::size_t name = at + begin.size();
    const std::size_t end = expected.find('"', name);
    const std::string text(source(expected.substr(name, end - name)));
    // Also replaces the closing quotation mark and the end of the line.
    expected.replace(at, end + 2 - at, text);
  }
  EXPECT_GE(included, 5);
  EXPECT_EQ(whole_source("raycast.glsl"), expected);
}

TEST(Sources, WithoutIncludesIsUnchanged) {
  EXPECT_EQ(whole_source("preintegrated.glsl"), source("preintegrated.glsl"));
  EXPECT_THROW(static_cast<void>(whole_source("no_such.glsl")), std::out_of_range);
}

}  // namespace
}  // namespace triptych::technique
