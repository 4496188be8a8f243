#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "particle_text.hpp"
#include "raw_files.hpp"
#include "scene/file_content.hpp"
#include "scene/particles.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::scene {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string replaced(std::string text, const std::string& old, const std::string& with) {
  return text.replace(text.find(old), old.size(), with);
}

const std::string pdb =
    "HEADER    PLANT PROTEIN                           30-APR-81   1CRN\n"
    "ATOM      1  N   THR A   1      17.047  14.099   3.625  1.00 13.79           N  \n"
    "ATOM      2  CA  THR A   1      16.967  12.784   4.338  1.00 10.80           C  \n"
    "TER\n"
    "HETATM    3 CA    CA A   2       1.000   2.000-100.500  1.00 10.80          CA  \n"
    "END\n";

TEST(Pdb, TakesElementsFromTheirColumns) {
  const ParticleSet set = load("a.pdb", pdb);
  EXPECT_THAT(set.spheres,
              ElementsAre(Sphere{17.047F, 14.099F, 3.625F, 1.55F},
                          Sphere{16.967F, 12.784F, 4.338F, 1.7F}, Sphere{1, 2, -100.5F, 2}));
  EXPECT_THAT(set.ids, ElementsAre(0U, 1U, 2U));
  EXPECT_EQ(set.name, "a.pdb");
  EXPECT_EQ(set.rgba8.size(), 3U);
  // The intensity is the normalised rank of the atomic number, here of C, N and Ca.
  EXPECT_THAT(load("a.pdb", pdb, ColourKind::intensity).intensity,
              ElementsAre(1.F / 3, 0.F, 2.F / 3));
}

TEST(Pdb, TakesElementsFromNamesIfThereAreNone) {
  const ParticleSet set = load("a.pdb",
                               "ATOM      1  CA  THR A   1       1.000   2.000   3.000\r\n"
                               "ATOM      2 1HB  THR A   1       1.000   2.000   3.000\r\n"
                               "HETATM    3 ZN    ZN A   1       1.000   2.000   3.000\r\n");
  EXPECT_EQ(set.spheres[0][3], 1.7F);
  EXPECT_EQ(set.spheres[1][3], 1.2F);
  EXPECT_EQ(set.spheres[2][3], 1.39F);
}

// In old files, columns 73 to 80 contain the entry's id and the line number.
TEST(Pdb, TakesElementsFromNamesIfTheirColumnsAreUnusable) {
  const ParticleSet set =
      load("a.pdb",
           "ATOM      1  CA  THR A   1       1.000   2.000   3.000  1.00 13.79      1CRN1070\n"
           "HETATM    2 ZN    ZN A   1       1.000   2.000   3.000  1.00 13.79      1CRN  71\n"
           "ATOM      3  N   THR A   1       1.000   2.000   3.000  1.00 13.79          XX\n");
  EXPECT_EQ(set.spheres[0][3], 1.7F);
  EXPECT_EQ(set.spheres[1][3], 1.39F);
  EXPECT_EQ(set.spheres[2][3], 1.55F);
}

TEST(Pdb, FramesAreModels) {
  const std::string atom = "ATOM      1  CA  THR A   1       1.000   2.000   3.000\n";
  const std::string text =
      "MODEL        1\n" + atom + "ENDMDL\nMODEL        2\n" + atom + atom + "ENDMDL\n";
  EXPECT_EQ(load("a.pdb", text).count(), 1U);
  EXPECT_EQ(load("a.pdb", text).facts.frames, 2U);
  EXPECT_EQ(load("a.pdb", text, ColourKind::rgba8, "@1").count(), 2U);
  EXPECT_EQ(load("a.pdb", text, ColourKind::rgba8, "@1").facts.frame, 1U);
  expect_refused("a.pdb", text, "", "no frame 2; number of frames in the file: 2", "@2");
  expect_refused("a.pdb", pdb, "", "no frame 1; number of frames in the file: 1", "@1");
  expect_refused("a.pdb", text.substr(0, text.size() - 7), ":6", "expected ENDMDL");
}

// VMD writes no MODEL records. Each frame ends with END and may begin with its own header.
TEST(Pdb, FramesWithoutModelsEndWithEnd) {
  const auto frame = [](int x) {
    return "CRYST1   52.000   58.600   61.900\nATOM      1  CA  THR A   1       " +
           std::to_string(x) + ".000   2.000   3.000\nEND\n";
  };
  const std::string text = frame(1) + frame(2) + "END\n" + frame(3);
  EXPECT_THAT(load("a.pdb", text).spheres, ElementsAre(Sphere{1, 2, 3, 1.7F}));
  EXPECT_THAT(load("a.pdb", text, ColourKind::rgba8, "@2").spheres,
              ElementsAre(Sphere{3, 2, 3, 1.7F}));
  expect_refused("a.pdb", text, "", "no frame 3; number of frames in the file: 3", "@3");
  // The last frame is cut off, which is an error regardless of the requested frame.
  const std::string atoms = replaced(frame(1), "CRYST1   52.000   58.600   61.900\n", "");
  expect_refused("a.pdb", atoms + atoms.substr(0, atoms.size() - 4), ":3:", "expected END");
  const std::string model = "MODEL        1\n" + atoms.substr(0, atoms.size() - 4) + "ENDMDL\n";
  expect_refused("a.pdb", atoms + model,
                 ":3:", "a MODEL record is not allowed after atoms that do not belong to a model");
}

TEST(Pdb, RejectsBrokenFiles) {
  expect_refused("a.pdb", replaced(pdb, "12.784", "12.x84"),
                 ":3:", "y in columns 39 to 46: expected a number, found '12.x84'");
  expect_refused("a.pdb", pdb.substr(0, 190), ":3:", "the file ends here, so it may be truncated");
  expect_refused("a.pdb", replaced(pdb, "END\n", ""), ":5:", "expected END");
  expect_refused("a.pdb", "REMARK\n", ":1:", "found none");
  const std::string atom = "ATOM      1  CA  THR A   1       1.000   2.000   3.000\n";
  for (const std::string head : {"TITLE     A PROTEIN\n", "CRYST1   52.000   58.600   61.900\n",
                                 "HEADER    VESTA_phase_1\n"}) {
    // Several programs write complete files without END. Only files with the id of an entry in the
    // Protein Data Bank in their HEADER must end with END, and these files have no such id.
    EXPECT_EQ(load("a.pdb", head + atom).count(), 1U);
    EXPECT_EQ(load("a.pdb", head + atom + "END\n").count(), 1U);
    EXPECT_EQ(load("a.pdb", head + "MODEL        1\n" + atom + "ENDMDL\n").count(), 1U);
  }
}

TEST(Pdb, DropsNonFinitePositions) {
  const ParticleSet set = load("a.pdb", replaced(pdb, "12.784", "   nan"));
  EXPECT_EQ(set.dropped, 1U);
  EXPECT_THAT(set.ids, ElementsAre(0U, 2U));
  EXPECT_EQ(set.rgba8.size(), 2U);
}

const std::string cif =
    "data_X # comment\n"
    "_struct.title   'It''s a \"title\"'\n"
    "_struct.text\n;loop_\n_atom_site.no\n;\n"
    "loop_\n_entity.id\n_entity.name\n1 'loop_ of names'\n"
    "loop_\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.Cartn_x\n"
    "_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.pdbx_PDB_model_num\n"
    "O \"O5'\" -12.750 53.499 64.877 1\n"
    "MG 'a b' 1 2 3\n 1\n"
    "C C 1 2 3 7\n"
    "#\nloop_\n_other.x\n1\n";

TEST(Mmcif, ReadsTheLoopOverAtoms) {
  const ParticleSet set = load("a.cif", cif);
  EXPECT_THAT(set.spheres,
              ElementsAre(Sphere{-12.75F, 53.499F, 64.877F, 1.52F}, Sphere{1, 2, 3, 1.73F}));
  EXPECT_EQ(load("a.cif", cif, ColourKind::rgba8, "@1").spheres[0][3], 1.7F);
  EXPECT_EQ(load("a.cif.gz", gzipped(cif)).hash, set.hash);
}

TEST(Mmcif, RejectsBrokenFiles) {
  expect_refused("a.cif", cif, "", "no frame 2; number of frames in the file: 2", "@2");
  expect_refused("a.cif", replaced(cif, "53.499", "?"),
                 ":18:", "Cartn_y: expected a number, found '?'");
  expect_refused("a.cif", replaced(cif, "C C 1 2 3 7", "C C 1 2"), "",
                 "expected 6 values in each row of _atom_site.*, found 4 in the last row");
  expect_refused("a.cif", replaced(cif, "_atom_site.Cartn_z", "_atom_site.z"), "",
                 "the column _atom_site.Cartn_z is missing");
  expect_refused("a.cif", "data_X\n", ":1:", "expected a loop over _atom_site.");
  expect_refused("a.cif", "data_X\n_a\n;text\n", ":3:", "the ';' that ends a text field");
  expect_refused("a.cif", "data_X\n_a 'text\n", ":2:", "expected a closing quote (')");
}

// In files of the Protein Data Bank, every section, including the header, ends with a line '#'. If
// the last section lacks this line, the file was truncated.
TEST(Mmcif, RejectsATruncatedLoop) {
  const std::string loop =
      "loop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
      "_atom_site.Cartn_z\nC 1 2 3\nN 4 5 6\n";
  const std::string closing = "data_X\n# \n_entry.id X\n#\n_cell.a 1\n#\n_struct.b 1\n#\n" + loop;
  expect_refused("a.cif", closing, ":15:", "unexpected end of file; expected '#'");
  EXPECT_EQ(load("a.cif", closing + "#\n").count(), 2U);
  EXPECT_EQ(load("a.cif", closing + "_entry.more 1\n").count(), 2U);
  // If the file contains only a few '#' lines, the reader only adds a note.
  const ParticleSet unsure = load("a.cif", "data_X\n#\n_entry.id X\n#\n" + loop);
  EXPECT_THAT(unsure.facts.notes, ElementsAre(HasSubstr("the file may be truncated")));
  // Some programs write '#' only between sections, or not at all.
  EXPECT_EQ(load("a.cif", "# made by hand\n#\ndata_X\n_entry.id X\n#\n" + loop).count(), 2U);
  EXPECT_EQ(load("a.cif", "data_X\n" + loop).count(), 2U);
  // A comment before the first section, such as the name that OpenMM writes, does not show that the
  // file ends its sections with '#'.
  for (const std::string marks : {"# Created with OpenMM 8.1\n#\n", "# by hand\n", "#\n#\n"}) {
    EXPECT_EQ(load("a.cif", "data_cell\n" + marks + "_cell.length_a 1\n#\n" + loop).count(), 2U)
        << marks;
  }
}

const std::string gro =
    "Title\n"
    " 4\n"
    "    1POPC   C12    1   0.519   8.005   7.185\n"
    "    1POPC  H12A    2   1.000  -2.000   3.000  0.1  0.1  0.1\n"
    "    2NA      NA    3   0.000   0.000   0.000\n"
    "    3ALA     CA99999   0.000   0.000   1.000\n"
    "   8.13950   8.13950  10.40000\n";

TEST(Gro, IsInNanometres) {
  const ParticleSet set = load("a.gro", gro);
  EXPECT_THAT(set.spheres, ElementsAre(Sphere{0.519F, 8.005F, 7.185F, 0.17F},
                                       Sphere{1, -2, 3, static_cast<float>(1.2 * 0.1)},
                                       Sphere{0, 0, 0, static_cast<float>(2.27 * 0.1)},
                                       Sphere{0, 0, 1, static_cast<float>(1.7 * 0.1)}));
}

TEST(Gro, TakesAnyNumberOfDecimalsAndFrames) {
  const std::string fine = "Title\n1\n    1POPC   C12    1   0.51912-118.00512   7.18512\n 1 2 3\n";
  EXPECT_EQ(load("a.gro", fine).spheres[0][1], -118.00512F);
  EXPECT_EQ(load("a.gro", fine + gro, ColourKind::rgba8, "@1").count(), 4U);
  expect_refused("a.gro", fine + gro, "", "no frame 2; number of frames in the file: 2", "@2");
  const ReadFacts facts = load("a.gro", fine + gro).facts;
  EXPECT_EQ(facts.frames, 2U);
  EXPECT_EQ(facts.box_edges, (BoxEdges{{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}}}));
  // A broken frame does not prevent the frames before it from being read.
  EXPECT_FALSE(load("a.gro", fine + "Title\nmany\n").facts.frames.has_value());
  const std::string tilted = replaced(fine, " 1 2 3\n", " 1 2 3 4 5 6 7 8 9\n");
  EXPECT_EQ(load("a.gro", tilted).facts.box_edges, (BoxEdges{{{1, 4, 5}, {6, 2, 7}, {8, 9, 3}}}));
}

TEST(Gro, RejectsBrokenFiles) {
  expect_refused("a.gro", replaced(gro, " 4\n", " 3\n"), ":6:", "expected the box");
  expect_refused("a.gro", replaced(gro, " 4\n", " 5\n"), ":7:", "expected an atom");
  expect_refused("a.gro", replaced(gro, " 4\n", " 9\n"), ":7:", "");
  expect_refused("a.gro", replaced(gro, " 4\n", " four\n"),
                 ":2:", "expected the number of atoms, found 'four'");
  expect_refused("a.gro", replaced(gro, " 4\n", " 4294967295\n"),
                 ":2:", "(the limit is 4294967294)");
  expect_refused("a.gro", replaced(gro, "-2.000", "-2.0o0"), ":4:", "y: expected a number");
  expect_refused("a.gro", gro.substr(0, 90), ":4:", "expected an atom with its position");
  expect_refused("a.gro", gro.substr(0, gro.size() - 31), ":6:", "expected the box");
  expect_refused("a.gro", "Title\n", ":1:", "expected the number of atoms");
}

const std::string xyz = "3\ncomment\nC 0 0 0\nO1 1 2 3 0.5 extra\n30 1e1 +2 -3\n";

TEST(Xyz, TakesSymbolsAndAtomicNumbers) {
  EXPECT_THAT(load("a.xyz", xyz).spheres,
              ElementsAre(Sphere{0, 0, 0, 1.7F}, Sphere{1, 2, 3, 1.52F}, Sphere{10, 2, -3, 1.39F}));
  EXPECT_EQ(load("a.xyz", xyz).facts.frames, 1U);
  EXPECT_EQ(load("a.xyz", xyz + xyz + "\n" + xyz, ColourKind::rgba8, "@1").facts.frames, 3U);
  EXPECT_EQ(load("a.XYZ", xyz + "1\n\nXx 5 5 5\n\n", ColourKind::rgba8, "@1").spheres[0][3], 2.F);
}

TEST(Xyz, OneElementHasTheRankAsIntensity) {
  EXPECT_THAT(
      load("a.xyz", "4\n\nC 0 0 0\nC 1 0 0\nC 0 inf 0\nC 2 0 0\n", ColourKind::intensity).intensity,
      ElementsAre(0.F, 0.25F, 0.75F));
}

// The comment line of an extended XYZ file names the columns.
TEST(Xyz, TakesColumnsFromProperties) {
  const std::string rows = "7 0.5 1 2 3 C\n8 0.5 4 5 6 O\n";
  const auto with = [&](const std::string& comment) { return "2\n" + comment + "\n" + rows; };
  const std::string list = "id:I:1:charge:R:1:pos:R:3:species:S:1";
  const auto expected = ElementsAre(Sphere{1, 2, 3, 1.7F}, Sphere{4, 5, 6, 1.52F});
  for (const std::string& comment :
       {"Properties=" + list, "Lattice=\"9 0 0 0 9 0 0 0 9\" Properties=" + list + " energy=-1",
        "pbc=\"T T F\" properties=\"" + list + "\"", "note=\"Properties=x\" Properties=" + list}) {
    EXPECT_THAT(load("a.xyz", with(comment)).spheres, expected) << comment;
  }
  EXPECT_EQ(load("a.xyz", "1\nNo Properties, \"Properties=x\"\nC 1 2 3 4\n").count(), 1U);
  // Each frame has its own column names.
  const std::string frames =
      with("Properties=" + list) + "1\nProperties=species:S:1:pos:R:3\nO 1 2 3\n";
  EXPECT_THAT(load("a.xyz", frames, ColourKind::rgba8, "@1").spheres,
              ElementsAre(Sphere{1, 2, 3, 1.52F}));

  expect_refused("a.xyz", with("Properties=" + list + ":mass:R:1"),
                 ":3:", "expected 7 columns, as declared by Properties, found 6");
  expect_refused("a.xyz", with("Properties=id:I:1:pos:R:3"),
                 ":2:", "expected Properties with species or Z (1 column) and pos (3 columns)");
  expect_refused("a.xyz", with("Properties=species:S:1:pos:R:2"), ":2:", "and pos (3 columns)");
  for (const char* broken :
       {"", "species:S", "species:S:1:pos:R:three", "species:S:0:pos:R:3", "species:X:1:pos:R:3"}) {
    expect_refused("a.xyz", with(std::string("Properties=") + broken),
                   ":2:", "expected Properties=NAME:TYPE:COUNT:…");
  }
}

TEST(Xyz, RejectsBrokenFiles) {
  expect_refused("a.xyz", replaced(xyz, "3\n", "2\n"), ":5:", "the next frame's number of atoms");
  expect_refused("a.xyz", "1\nProperties=species:S:1:pos:R:3 \"note\nC 0 0 0\n",
                 ":2:", "a quote or bracket is not closed");
  expect_refused("a.xyz", replaced(xyz, "3\n", "4\n"),
                 ":5:", "unexpected end of file; expected 4 atoms");
  expect_refused("a.xyz", replaced(xyz, "O1 1 2 3", "O1 1 2,0 3"),
                 ":4:", "y: expected a number, found '2,0'");
  expect_refused("a.xyz", replaced(xyz, "O1 1 2 3 0.5 extra", "O1 1 2"),
                 ":4:", "expected an element, x, y and z");
  expect_refused("a.xyz", replaced(xyz, "30", "300"), ":5:", "expected an element, found '300'");
  expect_refused("a.xyz", "-1\n\n", ":1:", "expected the number of atoms, found '-1'");
  expect_refused("a.xyz", "0\n\n", ":2:", "expected atoms, found none");
  expect_refused("a.xyz", xyz, "", "no frame 1; number of frames in the file: 1", "@1");
  // If the stated count exceeds the size of the file, the reader must not allocate that much
  // memory.
  expect_refused("a.xyz", replaced(xyz, "3\n", "4294967294\n"), ":5:", "unexpected end of file");
}

TEST(ParticleFiles, AreFoundByNameFolderAndFrame) {
  const TemporaryFolder folder;
  folder.write("a.xyz", xyz);
  folder.write("b@1.xyz", xyz);
  EXPECT_TRUE(particles_present("a.xyz", {folder.path()}));
  EXPECT_TRUE(particles_present("a.xyz@3", {folder.path()}));
  EXPECT_TRUE(particles_present("b@1.xyz", {folder.path()}));
  EXPECT_TRUE(particles_present("generate:uniform:10"));
  EXPECT_FALSE(particles_present("c.xyz", {folder.path()}));
  EXPECT_FALSE(particles_present("a.xyz"));
  EXPECT_EQ(load_particles("b@1.xyz", ColourKind::rgba8, {folder.path()}).count(), 3U);
  EXPECT_EQ(load_particles("a.xyz@0", ColourKind::rgba8, {folder.path()}).name, "a.xyz@0");
  EXPECT_EQ(load_particles("generate:uniform:10", ColourKind::rgba8).count(), 10U);
  EXPECT_THROW(static_cast<void>(load_particles("c.xyz", ColourKind::rgba8, {folder.path()})),
               core::IoError);
  EXPECT_THROW(static_cast<void>(load_particles("a.xyz@b", ColourKind::rgba8, {folder.path()})),
               core::InputError);
}

TEST(ParticleFiles, RejectUnreadableFiles) {
  for (const std::string name : {"a.pdb", "a.cif", "a.gro", "a.xyz", "a.lammpstrj", "a.dump",
                                 "a.data", "a.lmp", "a.mmpld"}) {
    expect_refused(name, "", ": ", "is empty");
    expect_refused(name + ".gz", gzipped(""), ": ", "is empty");
    expect_refused(name, "\n", ":", "");
    expect_refused(name, std::string(1000, '\0'), ":", "");
  }
  const std::string packed = gzipped(xyz);
  expect_refused("a.xyz.gz", packed.substr(0, packed.size() - 9), ": ", "broken gzip stream");
  expect_refused("a.xyz.gz", xyz, ": ", "not a gzip stream");
  expect_refused("a.abc", xyz, ": ", "'.abc' is not a known particle format; expected .pdb");
  EXPECT_THAT([] { static_cast<void>(load_particles("generate:uniform", ColourKind::rgba8)); },
              ThrowsMessage<core::InputError>(HasSubstr("expected generate:NAME:COUNT")));
  EXPECT_THROW(static_cast<void>(load_particles("generate:uniform:1e3", ColourKind::rgba8)),
               core::InputError);
}

// A file without usable particles is rejected, because any device would draw its empty image
// correctly.
TEST(ParticleFiles, WithoutUsableParticlesAreRejected) {
  expect_refused("a.xyz", "2\n\nC nan 0 0\nC 0 inf 0\n", ": ",
                 "none of the 2 particles can be drawn");
  EXPECT_EQ(load("a.xyz", "2\n\nC nan 0 0\nC 0 0 0\n").dropped, 1U);
}

// Tapes and block devices pad the last block with zero bytes.
TEST(ParticleFiles, ZeroBytesAfterGzipAreSkipped) {
  const std::string padded = gzipped(xyz) + std::string(100'000, '\0');
  EXPECT_EQ(load("a.xyz.gz", padded).hash, load("a.xyz.gz", gzipped(xyz)).hash);
  expect_refused("a.xyz.gz", padded + "x", ": ",
                 "broken gzip stream: unexpected data after the zero padding");
  expect_refused("a.xyz.gz", padded + gzipped(xyz), ": ", "unexpected data after the zero padding");
}

TEST(ParticleFiles, UnpackingIsLimited) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.pdb.gz", gzipped(std::string(std::size_t{3} << 20, ' ')));
  EXPECT_EQ(read_content(file, {}, std::uint64_t{3} << 20).size(), std::size_t{3} << 20);
  EXPECT_THAT(
      [&] { static_cast<void>(read_content(file, {}, (std::uint64_t{3} << 20) - 1)); },
      ThrowsMessage<core::InputError>(HasSubstr(
          "a.pdb.gz: the file decompresses to more than 3145727 bytes; if this is intended")));
}

// Messages quote file contents as one printable line, whatever the file contains.
TEST(ParticleFiles, QuoteShortlyAndPrintably) {
  const std::string quoted = "found '" + std::string(40, '7') + "…'";
  expect_refused("a.xyz", std::string(100, '7') + "\n", ":1:", quoted);
  expect_refused("a.xyz", "1\n\nC 0 0 " + std::string(400, '7') + "x\n", ":3:", quoted);
  expect_refused("a.xyz", "1\n\nC 0 0 1\x1b[2Jµ\xff\x80\n",
                 ":3:", "found '1\uFFFD[2Jµ\uFFFD\uFFFD'");
  expect_refused("a.xyz", "1\n\n-\x7f 0 0 0\n", ":3:", "expected an element, found '-\uFFFD'");
  expect_refused("a.dump", std::string(100, '7') + "\n", ":1:", quoted);
}

TEST(ParticleFiles, ReportProgressInHundredths) {
  std::string text = "10000\n\n";
  for (int i = 0; i < 10'000; ++i) text += "C " + std::to_string(i) + " 0 0\n";
  const TemporaryFolder folder;
  folder.write("a.xyz", text);
  folder.write("a.xyz.gz", gzipped(text));
  for (const char* name : {"a.xyz", "a.xyz.gz"}) {
    double last = 0;
    const ParticleSet set =
        load_particles(name, ColourKind::rgba8, {folder.path()}, [&](double share) {
          EXPECT_GE(share, last);
          EXPECT_LE(share, last + 0.0105) << name;
          last = share;
        });
    EXPECT_EQ(last, 1);
  }
}

}  // namespace
}  // namespace triptych::scene
