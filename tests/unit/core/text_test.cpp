#include "core/text.hpp"

#include <gtest/gtest.h>

#include "core/json_text.hpp"

namespace triptych::core {
namespace {

using namespace std::string_view_literals;

TEST(Text, ALineIsUtf8WithoutControlCharacters) {
  for (const auto line : {""sv, "a b"sv, "größe"sv, "\u9AD4\U0001F9CA"sv, "\U0010FFFD"sv}) {
    EXPECT_TRUE(is_line(line)) << line;
  }
  for (const auto line : {"a\nb"sv, "a\0b"sv, "\x7f"sv, "\x1b[2J"sv, "\u0085"sv, "\u2028"sv,
                          "\u202E"sv, "\u2066"sv, "\uFEFF"sv, "\U000E0041"sv}) {
    EXPECT_FALSE(is_line(line)) << line;
  }
}

TEST(Text, InvalidUtf8IsNotALine) {
  constexpr auto alone = "\x80"sv;
  constexpr auto cut = "a\xe9\xab"sv;
  constexpr auto overlong = "\xc0\xaf"sv;
  constexpr auto surrogate = "\xed\xa0\x80"sv;
  constexpr auto beyond = "\xf4\x90\x80\x80"sv;
  for (const auto text : {alone, cut, overlong, surrogate, beyond, "\xff"sv}) {
    EXPECT_FALSE(is_line(text));
  }
}

TEST(JsonText, ReplacesInvalidUtf8) {
  EXPECT_EQ(json_text(Json{{"a", "x\xff"}}), "{\"a\":\"x\uFFFD\"}");
  EXPECT_EQ(repaired_utf8("größe"), "größe");
  EXPECT_EQ(repaired_utf8("x\xff"), "x\uFFFD");
}

TEST(JsonText, EscapesHiddenCharacters) {
  const Json json{{"a\u202E", "\x7f\u0085\U000E0041 größe\n"}};
  const std::string text = json_text(json);
  EXPECT_EQ(text, "{\"a\\u202e\":\"\\u007f\\u0085\\udb40\\udc41 größe\\n\"}");
  EXPECT_EQ(Json::parse(text), json);
  EXPECT_EQ(json_text(Json{1, 2}, 1), "[\n 1,\n 2\n]");
}

}  // namespace
}  // namespace triptych::core
