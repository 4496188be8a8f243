#include "core/hash.hpp"

#include <gtest/gtest.h>

namespace triptych::core {
namespace {

// Values of the XXH3 specification's reference implementation (XXH128, seed 0).
TEST(ContentHash, MatchesTheSpecification) {
  EXPECT_EQ(content_hash(std::string_view{}), "99aa06d3014798d86001c324468d497f");
}

TEST(ContentHash, TellsContentsApart) {
  const std::string_view text = "the same";
  EXPECT_EQ(content_hash(text), content_hash(std::as_bytes(std::span(text))));
  EXPECT_NE(content_hash("abc"), content_hash("abd"));
  EXPECT_NE(content_hash("abc"), content_hash(std::string_view("abc\0", 4)));
  EXPECT_EQ(content_hash(text).size(), 32U);
}

}  // namespace
}  // namespace triptych::core
