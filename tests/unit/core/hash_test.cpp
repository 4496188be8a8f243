#include "core/hash.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "core/json_text.hpp"

namespace triptych::core {
namespace {

// Values from the reference implementation of XXH3 (XXH128, seed 0).
TEST(ContentHash, MatchesTheSpecification) {
  EXPECT_EQ(content_hash(std::string_view{}), "99aa06d3014798d86001c324468d497f");
}

TEST(ContentHash, DistinguishesContents) {
  const std::string_view text = "the same";
  EXPECT_EQ(content_hash(text), content_hash(std::as_bytes(std::span(text))));
  EXPECT_NE(content_hash("abc"), content_hash("abd"));
  EXPECT_NE(content_hash("abc"), content_hash(std::string_view("abc\0", 4)));
  EXPECT_EQ(content_hash(text).size(), 32U);
}

// These hashes must be the same on every machine, because they identify entries in stores and
// baselines.
TEST(HashBuilder, IsTheSameEverywhere) {
  const auto of_parts = [](std::int64_t number, double real, std::string_view text) {
    return HashBuilder("kind").add(number).add(real).add(text).hash();
  };
  EXPECT_EQ(HashBuilder("").hash(), "2c0a8a99dc147d5445c3b49d035665b2");
  EXPECT_EQ(of_parts(-1, 0.0, "text"), "49124c58c5d36ea99a5ffe3260dd3f62");
  EXPECT_EQ(of_parts(1, -0.0, ""), "fe8a47eb9423ebb8e2da26bf6fe553a8");
  EXPECT_EQ(of_parts(std::numeric_limits<std::int64_t>::min(), 0x1p-1074, "µ"),
            "a263d7563acdf4881227db30e7e178b4");
  const std::array<std::uint32_t, 2> words{0x01020304, 0xFFFFFFFF};
  const std::array<float, 2> floats{0.1F, -0.0F};
  EXPECT_EQ(HashBuilder("arrays").add_array(std::span(words)).add_array(std::span(floats)).hash(),
            "29adb5fd749cbee7e7abf92d5dbcf0bb");
}

TEST(HashBuilder, HashesTheDocumentedBytes) {
  std::string bytes("\4\0\0\0\0\0\0\0kind", 12);
  bytes += std::string("\x04\x03\x02\x01\0\0\0\0", 8);          // 0x01020304
  bytes += std::string("\xFE\xFF\xFF\xFF\xFF\xFF\xFF\xFF", 8);  // −2
  bytes += std::string("\0\0\0\0\0\0\xF8\x3F", 8);              // 1.5
  EXPECT_EQ(HashBuilder("kind").add(0x01020304).add(-2).add(1.5F).hash(), content_hash(bytes));
}

TEST(HashBuilder, DistinguishesParts) {
  EXPECT_NE(HashBuilder("a").add("bc").hash(), HashBuilder("ab").add("c").hash());
  EXPECT_NE(HashBuilder("a").add(0.0).hash(), HashBuilder("a").add(-0.0).hash());
  EXPECT_NE(HashBuilder("a").add(1).hash(), HashBuilder("a").add(1.0).hash());
  EXPECT_EQ(HashBuilder("a").add(1U).hash(), HashBuilder("a").add(std::int64_t{1}).hash());
  EXPECT_EQ(HashBuilder("a").add(0.1F).hash(), HashBuilder("a").add(double{0.1F}).hash());
}

TEST(JsonHash, IsTheSameEverywhere) {
  const Json json{{"z", {1, -2, 0.1, 0.5F}}, {"a", "text"}, {"none", nullptr}, {"yes", true}};
  EXPECT_EQ(json_hash(json), "0c23a8c09974b57ad8981f25f98be6f7");
  EXPECT_NE(json_hash(Json(0.1)), json_hash(Json(std::nextafter(0.1, 1.0))));
}

}  // namespace
}  // namespace triptych::core
