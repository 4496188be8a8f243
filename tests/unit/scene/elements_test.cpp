#include "scene/elements.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "scene/element_names.hpp"

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

struct NamedCase {
  const char* atom;
  const char* residue;
  const char* symbol;
  bool guessed;
};

TEST(Elements, FollowFromNamesAndResidues) {
  const std::vector<NamedCase> cases{
      {"CA", "ALA", "C", false},
      {"1HB", "ALA", "H", false},
      {"HG2", "ARG", "H", false},
      {"NH1", "NARG", "N", false},
      {"OXT", "CGLY", "O", false},
      {"SE", "MSE", "Se", false},
      {"SD", "MET", "S", false},
      {"O5'", "DA5", "O", false},
      {"P", "U", "P", false},
      {"OW", "SOL", "O", false},
      {"MW", "TIP4", "X", true},
      {"NA", "HEM", "N", false},
      {"FE", "HEM", "Fe", false},
      {"MG", "CLA", "Mg", false},
      {"CHA", "CLA", "C", false},
      // Ions, named as elements and as CHARMM, AMBER and GROMACS write them.
      {"NA", "NA", "Na", false},
      {"CL", "CL-", "Cl", false},
      {"CA", "CA", "Ca", false},
      {"CA", "CA2+", "Ca", false},
      {"SOD", "SOD", "Na", false},
      {"CLA", "CLA", "Cl", false},
      {"POT", "POT", "K", false},
      {"CAL", "CAL", "Ca", false},
      {"Na+", "Na+", "Na", false},
      {"ZN", "ZN2", "Zn", false},
      {"SOD", "IONS", "Na", false},
      {"NA", "SOD", "Na", false},
      {"K", "K", "K", false},
      {"CD", "CD", "Cd", false},
      {"FE", "FE2", "Fe", false},
      // The tables do not contain these residues, so the element is guessed from the atom name.
      {"CL1", "LIG", "Cl", true},
      {"BR", "LIG", "Br", true},
      {"SI", "LIG", "Si", true},
      {"CA", "LIG", "C", true},
      {"C12", "LIG", "C", true},
      {"ZN", "LIG", "Zn", true},
      {"HO", "LIG", "H", true},
      {"*", "LIG", "X", true},
      {"", "", "X", true},
  };
  for (const auto& [atom, residue, symbol, guessed] : cases) {
    const NamedElement element = element_of_name(atom, residue);
    EXPECT_EQ(element.symbol, symbol) << atom << ' ' << residue;
    EXPECT_EQ(element.guessed, guessed) << atom << ' ' << residue;
  }
}

TEST(Elements, FollowFromColumnsWhereTheResidueIsUnknown) {
  EXPECT_EQ(element_of_columns("CA  ", "LIG").symbol, "Ca");
  EXPECT_EQ(element_of_columns(" CA ", "LIG").symbol, "C");
  EXPECT_EQ(element_of_columns("HG11", "LIG").symbol, "H");
  EXPECT_EQ(element_of_columns("CA  ", "ALA").symbol, "C") << "the residue decides";
  EXPECT_EQ(element_of_columns(" SOD", "SOD").symbol, "Na");
  EXPECT_FALSE(element_of_columns("HG  ", "LIG").guessed);
  EXPECT_TRUE(element_of_columns("HG11", "LIG").guessed);
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
