// Tests mistakes that the readers of other programs have made: ignored lines, wrong elements,
// numbers split at the wrong columns, grammars that are only partly supported. Each case is based
// on a public bug report; the data were created for these tests.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "particle_text.hpp"
#include "raw_files.hpp"
#include "scene/particles.hpp"
#include "scene/volume.hpp"

namespace triptych::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string pdb_atom(const std::string& name, const std::string& residue, const std::string& place,
                     const std::string& end = "  1.00  0.00") {
  std::string line = "HETATM    1 " + name + " " + residue + " A   1    " + place + end;
  return line + "\n";
}

std::string kinds_of(const ParticleSet& set) {
  std::string list;
  for (const auto& [name, count] : set.facts.kinds) {
    list += (list.empty() ? "" : " ") + name + std::to_string(count);
  }
  return list;
}

const std::string coordinates = "   1.000   2.000   3.000";

TEST(PdbColumns, NumbersThatRunTogetherAreRejected) {
  for (const char* place :
       {"1428.327-1130.277-624.974", "12345.67812345.67812345.678", "-1130.277-1130.277-1130.277",
        "   1.000-12345.678   3.000", "  12.3456   2.000   3.000", "   1.0000  2.0000  3.0000"}) {
    expect_refused("a.pdb", pdb_atom(" C  ", "LIG", place), ":1:", "");
  }
  // The number begins in column 30, which must be blank.
  std::string wide = pdb_atom(" C  ", "LIG", coordinates);
  wide.replace(29, 9, "12345.678");
  expect_refused("a.pdb", wide, ":1:", "x in columns 31 to 38: '2345.678' is not separated");
  // Numbers may touch if each of them fills its columns exactly.
  EXPECT_EQ(load("a.pdb", pdb_atom(" C  ", "LIG", "-123.456-123.456-123.456")).spheres[0][2],
            -123.456F);
  EXPECT_EQ(load("a.pdb", pdb_atom(" C  ", "LIG", "     1.0     2.0     3.0")).spheres[0][2], 3);
}

TEST(PdbRecords, RecordsThatBeginLikeAnAtomAreNotIgnored) {
  const std::string atom = pdb_atom(" C  ", "LIG", coordinates);
  const std::string rest = atom.substr(6);
  for (const char* begin :
       {"atom  ", "Atom  ", " ATOM ", "hetatm", "Hetatm", "ATOM\t ", "ATOM* "}) {
    expect_refused("a.pdb", begin + rest + atom, ":1:", "");
  }
  // The serial number has six digits, so it touches the record name.
  EXPECT_EQ(load("a.pdb", "ATOM 1" + std::string("00000") + atom.substr(11) + atom).count(), 2U);
  EXPECT_EQ(load("a.pdb", "HETATM100000" + atom.substr(12) + atom).count(), 2U);
  EXPECT_EQ(load("a.pdb", "REMARK ATOM\nATOMS IN ALL\nSIGATM\n" + atom).count(), 1U);
}

TEST(PdbElements, ComeFromTheResidueIfNamesAreLeftAligned) {
  const ParticleSet set = load(
      "a.pdb", pdb_atom("N   ", "ALA", coordinates) + pdb_atom("CA  ", "ALA", coordinates) +
                   pdb_atom("HG2 ", "ARG", coordinates) + pdb_atom("CD  ", "LIG", coordinates) +
                   pdb_atom("CA  ", " CA", coordinates));
  EXPECT_EQ(kinds_of(set), "H1 C2 N1 Ca1");
  EXPECT_THAT(set.facts.notes, ElementsAre(HasSubstr("not specify the element of 1 atom")));
}

TEST(PdbElements, ComeFromTheColumnsIfNamesAreRightAligned) {
  const ParticleSet set =
      load("a.pdb", pdb_atom(" CA ", "ALA", coordinates) + pdb_atom("CD  ", "LIG", coordinates) +
                        pdb_atom(" CD ", "LIG", coordinates));
  EXPECT_EQ(kinds_of(set), "C2 Cd1");
  EXPECT_THAT(set.facts.notes, IsEmpty());
}

// The last columns of a line, meant for the element, may contain part of a word. It must not be
// read as an element.
TEST(PdbElements, AreNotPartOfAWord) {
  const ParticleSet set =
      load("a.pdb",
           pdb_atom(" C1 ", "POPC", coordinates, "  1.00  0.00      MEMBRANE").replace(21, 1, "") +
               pdb_atom(" CA ", "ALA", coordinates, "  1.00  0.00      PROA C  "));
  EXPECT_EQ(kinds_of(set), "C2");
}

TEST(Elements, UnknownElementsAreReported) {
  const ParticleSet set = load("a.xyz", "3\n\nC 0 0 0\nXx 1 0 0\nXx 2 0 0\n");
  EXPECT_THAT(set.facts.notes, ElementsAre(HasSubstr("2 of 'Xx'")));
  EXPECT_EQ(kinds_of(load("a.xyz", "3\n\nN 0 0 0\nCA 1 0 0\nCB 2 0 0\n")), "C2 N1");
  EXPECT_EQ(kinds_of(load("a.xyz", "2\n\nCA 1 0 0\nO 2 0 0\n")), "O1 Ca1");
}

TEST(ByteOrderMark, IsIgnoredOrReported) {
  const std::string mark = "\xEF\xBB\xBF";
  const std::string atom = pdb_atom(" C  ", "LIG", coordinates);
  EXPECT_EQ(load("a.pdb", mark + atom + atom).count(), 2U);
  EXPECT_EQ(load("a.xyz", mark + "1\n\nC 0 0 0\n").count(), 1U);
  EXPECT_EQ(
      load("a.gro", mark + "t\n1\n    1SOL     OW    1   0.000   0.000   0.000\n 1 1 1\n").count(),
      1U);
  EXPECT_EQ(load("a.cif", mark + "data_x\n_atom_site.type_symbol C\n_atom_site.Cartn_x 1\n"
                                 "_atom_site.Cartn_y 1\n_atom_site.Cartn_z 1\n")
                .count(),
            1U);
  expect_refused("a.xyz",
                 std::string("\xFF\xFE"
                             "1\0\n\0",
                             6),
                 ": ", "UTF-16");
}

TEST(LineEnds, MayBeACarriageReturn) {
  EXPECT_EQ(load("a.xyz", "2\rx\rC 0 0 0\rO 1 0 0\r").count(), 2U);
}

TEST(Compression, IsDetectedFromTheContent) {
  const std::string atom = pdb_atom(" C  ", "LIG", coordinates);
  EXPECT_EQ(load("a.pdb", gzipped(atom)).count(), 1U);
  expect_refused("a.pdb",
                 "\xFD"
                 "7zXZ\0",
                 ": ", "compressed with xz; unpack it first: xz -d");
  expect_refused("a.pdb", "BZh9broken", ": ", "broken bzip2 stream");
}

TEST(Content, OfAnotherFormatIsReported) {
  expect_refused("a.pdb", "data_1ABC\n#\n", ": ", "looks like mmCIF; if the content is correct");
  expect_refused("a.xyz", "ITEM: TIMESTEP\n0\n", ": ", "looks like LAMMPS dump");
  const std::string dump =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id x y z\n1 0 0 0\n";
  EXPECT_EQ(load("a.lammps", dump).facts.format, "LAMMPS dump");
  EXPECT_EQ(load("unknown.ending", dump).count(), 1U);
  expect_refused("a.xtc", "x", ": ", "gmx trjconv");
}

TEST(ExtendedXyz, FollowsItsSpecification) {
  const auto second = [](const std::string& comment) {
    return load("a.xyz", "1\n" + comment + "\nC 1 2 3 7 8 9\n").spheres.at(0)[0];
  };
  const std::string forces_last = "Properties=species:S:1:pos:R:3:forces:R:3";
  EXPECT_EQ(second(forces_last), 1);
  EXPECT_EQ(second("Properties=species:S:1:forces:R:3:pos:R:3"), 7);
  for (const char* before :
       {"note=\"5\\\" Properties=species:S:1:forces:R:3:pos:R:3\" ", "a=[[\"]\", 2], [3, 4]] ",
        "\"a key\" = {1 2 3} ", "flag other=\"\" ", "x = y "}) {
    EXPECT_EQ(second(before + forces_last), 1) << before;
  }
  EXPECT_EQ(second("Properties = \"species:S:1:forces:R:3:pos:R:3\""), 7);
  EXPECT_EQ(second("don't read \"Properties"), 1);
  const ParticleSet numbers = load("a.xyz", "2\nProperties=Z:I:1:pos:R:3\n6 0 0 0\n8 1 0 0\n");
  EXPECT_EQ(kinds_of(numbers), "C1 O1");
  EXPECT_THAT(numbers.facts.notes, IsEmpty());
  const ParticleSet quoted =
      load("a.xyz", "1\nProperties=name:S:1:species:S:1:pos:R:3\n\"a \\\" b\" C 1D0 2 3\n");
  EXPECT_EQ(quoted.spheres[0][0], 1);
}

TEST(MmcifRows, MayComeInAnyOrder) {
  const std::string text =
      "data_X\nloop_\n_atom_site.pdbx_PDB_model_num\n_atom_site.type_symbol\n_atom_site.Cartn_x\n"
      "_atom_site.Cartn_y\n_atom_site.Cartn_z\n1 C 1 0 0\n2 C 2 0 0\n1 C 3 0 0\n2 C 4.5(2) 0 0\n";
  EXPECT_EQ(load("a.cif", text).spheres[1][0], 3);
  EXPECT_EQ(load("a.cif", text, ColourKind::rgba8, "@1").spheres[1][0], 4.5F);
  expect_refused("a.cif", text, "", "number of frames in the file: 2", "@2");
}

TEST(MmcifElements, ComeFromNamesIfTheyAreNotStated) {
  const ParticleSet set =
      load("a.cif",
           "data_X\nloop_\n_atom_site.label_atom_id\n_atom_site.label_comp_id\n"
           "_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
           "_atom_site.Cartn_z\nCA ALA ? 1 0 0\nCA CA . 2 0 0\nFE HEM FE3+ 2 0 0\n");
  EXPECT_EQ(kinds_of(set), "C1 Ca1 Fe1");
}

TEST(GroColumns, AreCheckedWithTheirNeighbours) {
  const std::string head = "t\n 2\n    1SOL     OW    1   0.000   0.000   0.000\n";
  const std::string end = " 1 1 1\n";
  EXPECT_EQ(load("a.gro", head + "    1SOL     OW    2-999.000-999.000-999.000\n" + end).count(),
            2U);
  expect_refused("a.gro", head + "    1SOL     OW    210000.000   0.000   0.000\n" + end,
                 ":4:", "");
  expect_refused("a.gro", "t\n 1\n    1SOL     OW    110000.00010000.00010000.000\n" + end,
                 ":3:", "too wide");
}

TEST(Pqr, HasItsOwnRadii) {
  const std::string text =
      "REMARK   1 made for a test\n"
      "ATOM      1  N   ALA     1      46.457  12.189  21.556  0.1414 1.8240\n"
      "ATOM      2  CA  ALA A   1      47.614  11.997  22.448  0.0962 1.9080\nTER\nEND\n";
  const ParticleSet set = load("a.pqr", text);
  EXPECT_THAT(set.spheres, ElementsAre(Sphere{46.457F, 12.189F, 21.556F, 1.824F},
                                       Sphere{47.614F, 11.997F, 22.448F, 1.908F}));
  EXPECT_EQ(kinds_of(set), "C1 N1");
  expect_refused("a.pqr", "ATOM 1 N ALA 1 1 2-3 0 1\n", ":1:", "(10 or 11 words), found 9 words");
  expect_refused("a.pqr", "ATOM1 N ALA 1 1 2 3 0 1\n", ":1:", "expected a blank after ATOM");
}

// A file in a data folder outside the project, and the file to compare it with.
struct Row {
  const char* file;
  // The file with the same content, or nullptr if `file` only has to be readable.
  const char* expected_file;
};

TEST(ReaderCases, EveryRowOfTheTableIsRight) {
  const char* root = std::getenv("TRIPTYCH_DATA");
  const std::filesystem::path folder =
      std::filesystem::path(root == nullptr ? "" : root) / "readers";
  if (root == nullptr || !std::filesystem::is_directory(folder)) {
    GTEST_SKIP() << "TRIPTYCH_DATA does not name a folder that contains readers/";
  }
  const std::vector<Row> particles{{"p02_left_names.pdb", "p02_twin.xyz"},
                                   {"p04b_dexp.xyz", "p04_twin.xyz"},
                                   {"p04c_Z.xyz", "p04_twin.xyz"},
                                   {"p04d_starexp.xyz", nullptr},
                                   {"p04e_qm9.xyz", nullptr},
                                   {"p05_charmm_ions.pdb", "p05_twin.xyz"},
                                   {"p05b_charmm_ions.gro", nullptr},
                                   {"p05c_metals.gro", nullptr},
                                   {"p06_bom.pdb", "p06_twin.xyz"},
                                   {"p06b_bom.xyz", "p06_twin.xyz"},
                                   {"p07_pairs.cif", nullptr},
                                   {"p07c_noclose_mark.cif", nullptr},
                                   {"p08_huge_box.gro", nullptr},
                                   {"p10_noend.pdb", nullptr},
                                   {"p10f_endmdl_only.pdb", "p06_twin.xyz"},
                                   {"p11_gz_named.pdb", "p06_twin.xyz"},
                                   {"p13_lammps_dump.xyz", nullptr},
                                   {"p13d_escaped.xyz", "p13d_twin.xyz"},
                                   {"p13e_casp.pdb", nullptr}};
  for (const auto& [file, expected_file] : particles) {
    SCOPED_TRACE(file);
    const ParticleSet set = load_particles(file, ColourKind::rgba8, {folder});
    EXPECT_GT(set.count(), 0U);
    if (expected_file != nullptr) {
      EXPECT_EQ(set.hash, load_particles(expected_file, ColourKind::rgba8, {folder}).hash);
    }
  }
  for (const char* file : {"p03b_overflow4.pdb", "p13c_line.data"}) {
    EXPECT_THROW((void)load_particles(file, ColourKind::rgba8, {folder}), core::InputError) << file;
  }
  const auto kinds = [&](const char* file) {
    return kinds_of(load_particles(file, ColourKind::rgba8, {folder}));
  };
  EXPECT_EQ(kinds("p05b_charmm_ions.gro"), "Na1 Cl1 K1 Ca1");
  EXPECT_EQ(kinds("p05c_metals.gro"), "N1 Si1 Cl1 Fe1 Br1");
  const Volume expected = load_volume("v_twin.nrrd", {folder});
  for (const char* file :
       {"v01b_4d_one.nrrd", "v03_colon_keys.nrrd", "v08b_ascii.nrrd", "v08c_hex.nrrd",
        "v08d_bz2.nrrd", "v09_int.nrrd", "v09_uint32.nrrd", "v04_gz_minus1.nhdr", "v12_vmml.dat",
        "v13.mha", "v13.mhd", "v13.nrrd.gz", "v13.raw:6x5x4:u8:1x2x3"}) {
    EXPECT_EQ(load_volume(file, {folder}).voxels, expected.voxels) << file;
  }
  EXPECT_EQ(load_volume("v12c_iv3d.dat", {folder}).type, ScalarType::i16);
  // These files contain no volume: the NIfTI headers are empty, and the VTK files end before the
  // values. nibabel rejects the NIfTI files, and VTK finds no array in the VTK files.
  const std::map<std::string, std::string> reasons{
      {"v04.nii", "specifies neither dimensions nor a data type"},
      {"v04.nii.gz", "specifies neither dimensions nor a data type"},
      {"v13.vti", "contains no data"},
      {"v13.vtk", "expected POINT_DATA"}};
  for (const auto& [file, reason] : reasons) {
    try {
      (void)load_volume(file, {folder});
      ADD_FAILURE() << file << " was read";
    } catch (const core::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(reason));
    }
  }
}

}  // namespace
}  // namespace triptych::scene
