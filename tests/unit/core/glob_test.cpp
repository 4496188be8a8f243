#include "core/glob.hpp"

#include <gtest/gtest.h>

namespace triptych::core {
namespace {

TEST(Glob, MatchesWholeNames) {
  EXPECT_TRUE(glob_matches("vulkan:*", "vulkan:lavapipe"));
  EXPECT_TRUE(glob_matches("*pipe*osmesa", "gl:llvmpipe-osmesa"));
  EXPECT_TRUE(glob_matches("g?:*", "gl:softpipe"));
  EXPECT_TRUE(glob_matches("*", ""));
  EXPECT_TRUE(glob_matches("a*b*c", "abbbcbc"));
  EXPECT_FALSE(glob_matches("vulkan", "vulkan:lavapipe"));
  EXPECT_FALSE(glob_matches("gl:?", "gl:"));
  EXPECT_FALSE(glob_matches("", "x"));
  EXPECT_FALSE(glob_matches("a*b*c", "abbb"));
}

TEST(Glob, ManyStarsStayFast) {
  EXPECT_FALSE(glob_matches("*a*a*a*a*a*a*a*a*a*a*b", std::string(2000, 'a')));
}

}  // namespace
}  // namespace triptych::core
