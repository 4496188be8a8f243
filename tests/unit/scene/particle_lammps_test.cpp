#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "particle_text.hpp"

namespace triptych::scene {
namespace {

using testing::ElementsAre;

std::string dump(const std::string& columns, const std::string& count, const std::string& rows,
                 const std::string& box = "pp pp pp\n10 20\n-5 5\n0 4\n") {
  return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + count + "\nITEM: BOX BOUNDS " + box +
         "ITEM: ATOMS " + columns + "\n" + rows;
}

TEST(LammpsDump, SortsByIdWhateverTheColumnsOrder) {
  const std::string text =
      dump("mol z x id y type ", "3", "7 3 1 30 2 2 \n7 3 1 -1 4 1\n7 3 1 7 0 1\n");
  const ParticleSet set = load("a.lammpstrj", text);
  // The radius is half the median of the nearest-neighbour distances 2, 2 and 2.
  EXPECT_THAT(set.spheres, ElementsAre(Sphere{1, 4, 3, 1}, Sphere{1, 0, 3, 1}, Sphere{1, 2, 3, 1}));
  EXPECT_THAT(set.ids, ElementsAre(0U, 1U, 2U));
  EXPECT_EQ(set.rgba8[0], set.rgba8[1]);
  EXPECT_NE(set.rgba8[0], set.rgba8[2]);
  EXPECT_THAT(load("a.dump", text, ColourKind::intensity).intensity, ElementsAre(0.F, 0.F, 0.5F));
}

TEST(LammpsDump, TypesRankByNumberNotByText) {
  EXPECT_THAT(
      load("a.dump", dump("type x y z", "3", "10 0 0 0\n9 1 0 0\n2 2 0 0\n"), ColourKind::intensity)
          .intensity,
      ElementsAre(2.F / 3, 1.F / 3, 0.F));
}

TEST(LammpsDump, ReadsEveryKindOfPosition) {
  const auto place = [](const std::string& columns, const std::string& row,
                        const std::string& box = "pp pp pp\n10 20\n-5 5\n0 4\n") {
    return load("a.dump", dump("element " + columns, "1", "C " + row + "\n", box)).spheres.at(0);
  };
  EXPECT_EQ(place("xu yu zu", "1 2 3"), (Sphere{1, 2, 3, 1.7F}));
  EXPECT_EQ(place("xs ys zs", "0.5 0.25 1"), (Sphere{15, -2.5F, 4, 1.7F}));
  EXPECT_EQ(place("xsu ysu zsu", "1.5 0.25 1"), (Sphere{25, -2.5F, 4, 1.7F}));
  EXPECT_EQ(place("xs ys zs x y z", "0.5 0.5 0.5 1 2 3"), (Sphere{1, 2, 3, 1.7F}));
  // A box of 10 x 10 x 4 at (10, -5, 0), tilted by xy = -2, xz = 1 and yz = 3, has the bounds 8..21
  // in x and -5..8 in y.
  const std::string tilted = "xy xz yz pp pp pp\n8 21 -2\n-5 8 1\n0 4 3\n";
  EXPECT_EQ(place("xs ys zs", "0 0 0", tilted), (Sphere{10, -5, 0, 1.7F}));
  EXPECT_EQ(place("xs ys zs", "1 0.5 0.5", tilted), (Sphere{19.5F, 1.5F, 2, 1.7F}));
}

TEST(LammpsDump, UsesTheRadiiInTheFile) {
  EXPECT_THAT(load("a.dump", dump("type x y z radius", "2", "1 0 0 0 0.25\n1 9 0 0 3\n")).spheres,
              ElementsAre(Sphere{0, 0, 0, 0.25F}, Sphere{9, 0, 0, 3}));
  EXPECT_EQ(load("a.dump", dump("x y z diameter", "1", "0 0 0 3\n")).spheres[0][3], 1.5F);
  const ParticleSet set = load(
      "a.dump",
      dump("id x y z radius", "5", "4 0 0 0 1\n3 1 0 0 0\n2 2 0 0 -1\n1 3 0 0 nan\n0 4 0 0 2\n"));
  EXPECT_EQ(set.dropped, 3U);
  EXPECT_THAT(set.ids, ElementsAre(0U, 4U));
  EXPECT_THAT(set.spheres, ElementsAre(Sphere{4, 0, 0, 2}, Sphere{0, 0, 0, 1}));
}

TEST(LammpsDump, SelectsAFrame) {
  const std::string text = dump("x y z radius", "1", "1 0 0 1\n") +
                           "ITEM: UNITS\nlj\nITEM: TIME\n0.5\n" +
                           dump("x y z radius", "2", "2 0 0 1\n3 0 0 1\n");
  EXPECT_EQ(load("a.dump", text).count(), 1U);
  EXPECT_EQ(load("a.dump", text).facts.frames, 2U);
  EXPECT_EQ(load("a.dump", text, ColourKind::rgba8, "@1").facts.frames, 2U);
  EXPECT_EQ(load("a.dump", text, ColourKind::rgba8, "@1").spheres[1][0], 3);
  expect_refused("a.dump", text, "", "no frame 2; number of frames in the file: 2", "@2");
}

TEST(LammpsDump, RejectsBrokenFiles) {
  const std::string rows = "1 0 0 0\n2 1 0 0\n";
  expect_refused("a.dump", dump("id x y z", "1", rows),
                 ":11:", "expected the next frame after 1 atoms");
  expect_refused("a.dump", dump("id x y z", "3", rows),
                 ":11:", "unexpected end of file; expected 3 atoms");
  expect_refused("a.dump", dump("id x y z", "2.5", rows),
                 ":4:", "expected the number of atoms, found '2.5'");
  expect_refused("a.dump", dump("id x y z", "9999999999", rows), ":4:", "too many");
  expect_refused("a.dump", dump("id x y", "2", rows), ":9:", "expected columns x y z");
  expect_refused("a.dump", dump("id x y z", "2", "1 0 0 0\n1 1 0 0\n"),
                 ":11:", "atom number 1 appears twice");
  expect_refused("a.dump", dump("id x y z", "2", "1 0 0 0\n2 1 0\n"),
                 ":11:", "expected 4 values, found 3; the file ends here");
  expect_refused("a.dump", dump("id x y z", "2", "1 0 0 0\n2 1 zero 0\n"),
                 ":11:", "y: expected a number, found 'zero'");
  expect_refused("a.dump", dump("id x y z", "2", rows, "pp pp pp\n0 1\n0\n0 1\n"),
                 ":7:", "y bounds: expected 2 numbers");
  expect_refused("a.dump", dump("id x y z", "2", rows, "abc origin\n"), ":5:", "general triclinic");
  expect_refused("a.dump", "ITEM: ATOMS id x y z\n" + rows, ":1:", "NUMBER OF ATOMS before");
  expect_refused("a.dump", "ITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS xs ys zs\n0 0 0\n",
                 ":3:", "BOX BOUNDS before scaled");
  expect_refused("a.dump", "ITEM: TIMESTEP\n0\n", ":2:", "expected ITEM: ATOMS");
  expect_refused("a.dump", "TIMESTEP\n0\n", ":1:", "expected 'ITEM: …'");
}

std::string data(const std::string& section, const std::string& rows,
                 const std::string& count = "2") {
  return "A title\n\n " + count + " atoms\n2 atom types # comment\n0 10 xlo xhi\n\nMasses\n\n" +
         "1 12.0 # C\n2 1\n\n" + section + "\n\n" + rows;
}

TEST(LammpsData, ReadsEveryStyle) {
  const auto check = [](const std::string& section, const std::string& rows) {
    SCOPED_TRACE(section);
    const ParticleSet set = load("a.data", data(section, rows));
    EXPECT_THAT(set.spheres, ElementsAre(Sphere{1, 2, 3, 2}, Sphere{1, 2, 7, 2}));
    EXPECT_NE(set.rgba8.at(0), set.rgba8.at(1));
  };
  check("Atoms # atomic", "2 2 1 2 7\n1 1 1 2 3\n");
  check("Atoms", "2 2 1 2 7 # last\n1 1 1 2 3\n\nVelocities\n\n1 0 0 0\n");
  check("Atoms # atomic", "2 2 1 2 7 0 0 1\n1 1 1 2 3 0 0 0\n");
  check("Atoms # charge", "2 2 -0.5 1 2 7\n1 1 0.5 1 2 3\n");
  check("Atoms # molecular", "2 9 2 1 2 7\n1 9 1 1 2 3\n");
  check("Atoms # bond", "2 9 2 1 2 7\n1 9 1 1 2 3\n");
  check("Atoms # full", "2 9 2 0.1 1 2 7 0 0 0\n1 9 1 0.1 1 2 3 0 0 0\n");
  check("Atoms", "2 2 1.0 2 7 0 0 1\n1 1 1 2 3.0 -1 0 0\n");
  check("Atoms # electron", "2 2 0 1 0.5 1 2 7\n1 1 0 1 0.5 1 2 3\n");
  check("Atoms # dipole", "2 2 0 1 2 7 0 0 1\n1 1 0 1 2 3 0 0 1 0 0 0\n");
  check("Atoms # sphere", "2 2 4 1 1 2 7\n1 1 4 1 1 2 3\n");
}

TEST(LammpsData, RejectsBrokenFiles) {
  const std::string rows = "2 2 1 2 7\n1 1 1 2 3\n";
  expect_refused("a.data", data("Atoms", rows, "1"),
                 ":15:", "expected the section to end after 1 atoms");
  expect_refused("a.lmp", data("Atoms", rows, "3"),
                 ":15:", "unexpected end of file; expected 3 atoms");
  expect_refused("a.lmp", data("Atoms", rows + "\n", "3"),
                 ":16:", "the section ends after 2 atoms; expected 3 atoms");
  expect_refused("a.data", data("Atoms # hybrid", rows), ":12:", "found 'hybrid'");
  expect_refused("a.data", data("Atoms # full", rows), ":14:", "expected 7 columns, or 10");
  expect_refused("a.data", data("Atoms", "1 1 0.5 1 2 3\n2 1 0.5 1 2 3\n"),
                 ":14:", "the atom style is ambiguous for 6 columns");
  // These rows fit both the style `full` and the style `sphere`, the first without and the second
  // with image flags.
  for (const std::string row : {"1 9 1 0.1 1 2 3", "1 9 1 0.1 1 2 3 0 0 0"}) {
    expect_refused("a.data", data("Atoms", row + "\n", "1"),
                   ":14:", "expected a comment that names the style");
  }
  expect_refused("a.data", data("Atoms", "1 1 1 2 3 0 0 0\n", "1"), ":14:", "8 columns could be");
  // The style `electron` has eight columns, and the last three are the position.
  const std::string electron = "1 1 0.5 1 1.0 1.5 2.5 3.5\n";
  expect_refused("a.data", data("Atoms", electron, "1"),
                 ":14:", "the atom style is ambiguous for 8 columns");
  expect_refused("a.data", data("Atoms # atomic", electron, "1"),
                 ":14:", "image flag in x: expected a whole number, found '1.5'");
  expect_refused("a.data", data("Atoms # full", "1 9 1 0.1 1 2 3 0 0 0.5\n", "1"),
                 ":14:", "image flag in z: expected a whole number, found '0.5'");
  expect_refused("a.data", data("Atoms", "1 1 1.5 2 3 0 0 0\n2 1 1 2 3 0 x 0\n"),
                 ":15:", "image flag in y: expected a whole number, found 'x'");
  expect_refused("a.data", data("Atoms", "1 1 1 2 7\n1 1 1 2 3\n"),
                 ":15:", "atom number 1 appears twice");
  expect_refused("a.data", data("Atoms", "1 1 1 2 7\n2 1 1 - 3\n"), ":15:", "y: expected a number");
  expect_refused("a.data", data("Atoms", "1 1 1 2 7\n2x 1 1 1 3\n"),
                 ":15:", "id: expected a whole number");
  expect_refused("a.data", data("Bonds", ""), ":13:", "expected the Atoms section");
  expect_refused("a.data", "title\n\nAtoms\n\n1 1 0 0 0\n", ":3:", "expected 'N atoms'");
  expect_refused("a.data", data("Atoms", rows), "",
                 "no frame 1; a LAMMPS data file has only frame 0", "@1");
}

}  // namespace
}  // namespace triptych::scene
