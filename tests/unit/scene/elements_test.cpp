#include "scene/elements.hpp"

#include <gtest/gtest.h>

namespace triptych::scene {
namespace {

TEST(Elements, AreKnownInAnyCase) {
  EXPECT_EQ(atomic_number("H"), 1);
  EXPECT_EQ(atomic_number(" CL"), 17);
  EXPECT_EQ(atomic_number("og"), 118);
  EXPECT_EQ(atomic_number("D"), 1);
  EXPECT_EQ(atomic_number("Xx"), std::nullopt);
  EXPECT_EQ(atomic_number(""), std::nullopt);
  for (int number = 1; number <= 118; ++number) {
    EXPECT_EQ(atomic_number(*symbol_of(number)), number);
  }
  EXPECT_EQ(symbol_of(0), std::nullopt);
  EXPECT_EQ(symbol_of(119), std::nullopt);
}

TEST(Elements, HaveBondisRadii) {
  EXPECT_EQ(van_der_waals_radius("H"), 1.2);
  EXPECT_EQ(van_der_waals_radius("c"), 1.7);
  EXPECT_EQ(van_der_waals_radius("NA"), 2.27);
  EXPECT_EQ(van_der_waals_radius("CD"), 1.58);
  EXPECT_EQ(van_der_waals_radius("Ca"), 2.0);
  EXPECT_EQ(van_der_waals_radius("?"), 2.0);
}

TEST(Elements, OfNames) {
  EXPECT_EQ(element_from_name("CA", "ALA"), "C");
  EXPECT_EQ(element_from_name("1HB", "ALA"), "H");
  EXPECT_EQ(element_from_name("NA", "NA"), "Na");
  EXPECT_EQ(element_from_name("CL", "CL-"), "Cl");
  EXPECT_EQ(element_from_name("NA", "HEM"), "N");
  EXPECT_EQ(element_from_name("*", ""), "*");
}

TEST(Elements, ColoursDifferAndAreColours) {
  for (int number = 1; number < 118; ++number) {
    const Rgb rgb = element_colour(*symbol_of(number));
    for (const double channel : rgb) {
      EXPECT_GE(channel, 0);
      EXPECT_LE(channel, 1);
    }
    EXPECT_NE(rgb, element_colour(*symbol_of(number + 1))) << number;
  }
}

TEST(Elements, HuesRunFromRedToRed) {
  EXPECT_EQ(hue_colour(0, 1), (Rgb{1, 0, 0}));
  EXPECT_EQ(hue_colour(1, 1), (Rgb{1, 0, 0}));
  EXPECT_EQ(hue_colour(1.0 / 6, 1), (Rgb{1, 1, 0}));
  EXPECT_EQ(hue_colour(0.5, 1), (Rgb{0, 1, 1}));
  EXPECT_EQ(rgba8_of({1, 0.5, -2}), 0xFF0080FFU);
}

}  // namespace
}  // namespace triptych::scene
