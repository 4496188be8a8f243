#include "record/factor_list.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "core/random.hpp"

namespace triptych::record {
namespace {

using Factors = std::map<std::string, std::string>;

TEST(FactorList, StringsWithoutSeparatorsAreUnchanged) {
  for (const char* value : {"generate:mandelbulb:128", "a b", "50%", "%", "%%", "%2", "%2c", "%41",
                            "\\", "\"", "'", "ä", ""}) {
    EXPECT_EQ(escaped(value), value);
    EXPECT_EQ(unescaped(value), value);
  }
  EXPECT_EQ(factor_list({{"data", "cube"}, {"step", "0.5"}}), "data=cube,step=0.5");
}

TEST(FactorList, SeparatorsWithinAValue) {
  EXPECT_EQ(escaped("a,b=c.nrrd"), "a%2Cb%3Dc.nrrd");
  EXPECT_EQ(escaped("a%2Cb"), "a%252Cb");
  EXPECT_EQ(escaped("%25"), "%2525");
  EXPECT_EQ(factor_list({{"data", "x,step=2"}, {"step", "1"}}), "data=x%2Cstep%3D2,step=1");
}

TEST(FactorList, EntriesWithoutAFactorAreIgnored) {
  EXPECT_EQ(parse_factor_list(""), Factors{});
  EXPECT_EQ(parse_factor_list("none"), Factors{});
  EXPECT_EQ(parse_factor_list("a=1,none,,b="), (Factors{{"a", "1"}, {"b", ""}}));
}

// Tests all strings of up to six of the characters that have a meaning in a list of factors or in
// an escape sequence. Every string must survive escaping, and no two strings may have the same
// escaped form.
TEST(FactorList, UnescapingInvertsEscaping) {
  std::vector<std::string> values{""};
  std::set<std::string> texts;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string value = values[i];
    const std::string text = escaped(value);
    ASSERT_EQ(text.find_first_of(",="), std::string::npos) << value;
    ASSERT_EQ(unescaped(text), value) << text;
    ASSERT_TRUE(texts.insert(text).second) << text;
    if (value.size() < 6) {
      for (const char c : {',', '=', '%', '2', '3', '5', 'C', 'D'}) values.push_back(value + c);
    }
  }
}

TEST(FactorList, ParsingInvertsPrinting) {
  constexpr std::string_view characters = ",=%25C3D\\\"' a";
  core::Random random(7);
  const auto any = [&](std::size_t below) { return random.bits() % below; };
  for (int trial = 0; trial < 10'000; ++trial) {
    Factors factors;
    for (std::size_t factor = any(5); factor > 0; --factor) {
      std::string value;
      for (std::size_t length = any(12); length > 0; --length) {
        value += characters[any(characters.size())];
      }
      factors["factor_" + std::to_string(factor)] = value;
    }
    ASSERT_EQ(parse_factor_list(factor_list(factors)), factors) << factor_list(factors);
  }
}

}  // namespace
}  // namespace triptych::record
