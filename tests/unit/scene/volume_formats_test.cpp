#include "scene/volume_formats.hpp"

#include <bzlib.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "raw_files.hpp"
#include "scene/format_advice.hpp"
#include "scene/particle_formats.hpp"
#include "scene/text_lines.hpp"
#include "scene/volume.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::scene {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

Volume load_as_volume(const std::string& name, const std::string& bytes,
                      const Component& component = {}) {
  const TemporaryFolder folder;
  folder.write(name, bytes);
  return load_volume(name, {folder.path()}, component);
}

void expect_volume_refused(const std::string& name, const std::string& bytes,
                           const std::string& message) {
  EXPECT_THAT([&] { (void)load_as_volume(name, bytes); },
              ThrowsMessage<core::InputError>(AllOf(HasSubstr(name), HasSubstr(message))));
}

std::vector<double> values_of(const Volume& volume) {
  std::vector<double> values;
  for (std::size_t i = 0; i < volume.voxel_count(); ++i) values.push_back(volume.value(i));
  return values;
}

std::string bzip2ed(std::string plain) {
  std::string packed(plain.size() + 1000, '\0');
  auto size = static_cast<unsigned>(packed.size());
  BZ2_bzBuffToBuffCompress(packed.data(), &size, plain.data(), static_cast<unsigned>(plain.size()),
                           1, 0, 0);
  packed.resize(size);
  return packed;
}

// Builds a NIfTI header field by field, in the given byte order.
class Nifti {
 public:
  Nifti(int version, bool big)
      : version_(version), big_(big), bytes_(version == 1 ? 352 : 544, '\0') {
    put<std::int32_t>(0, version == 1 ? 348 : 540);
    bytes_.replace(version == 1 ? 344 : 4, 4, std::string(version == 1 ? "n+1" : "n+2") + '\0');
    offset(version == 1 ? 352 : 544);
  }
  Nifti& dims(const std::vector<int>& sizes) {
    for (std::size_t i = 0; i <= sizes.size(); ++i) {
      const int value = i == 0 ? static_cast<int>(sizes.size()) : sizes[i - 1];
      if (version_ == 1)
        put<std::int16_t>(40 + 2 * i, static_cast<std::int16_t>(value));
      else
        put<std::int64_t>(16 + 8 * i, value);
    }
    return *this;
  }
  Nifti& type(int code) {
    put<std::int16_t>(version_ == 1 ? 70 : 12, static_cast<std::int16_t>(code));
    return *this;
  }
  Nifti& pixdim(std::size_t i, double value) { return real(76, 104, i, value); }
  Nifti& scale(double slope, double intercept) {
    real(112, 176, 0, slope);
    return real(116, 184, 0, intercept);
  }
  Nifti& sform(const std::array<double, 12>& rows) {
    if (version_ == 1)
      put<std::int16_t>(254, 1);
    else
      put<std::int32_t>(348, 1);
    for (std::size_t i = 0; i < 12; ++i) real(280, 400, i, rows.at(i));
    return *this;
  }
  Nifti& offset(double value) {
    if (version_ == 1)
      put<float>(108, static_cast<float>(value));
    else
      put<std::int64_t>(168, static_cast<std::int64_t>(value));
    return *this;
  }
  Nifti& units(int code) {
    if (version_ == 1)
      bytes_[123] = static_cast<char>(code);
    else
      put<std::int32_t>(500, code);
    return *this;
  }
  [[nodiscard]] std::string with(const std::string& voxels) const { return bytes_ + voxels; }

 private:
  template <typename T>
  void put(std::size_t at, T value) {
    const std::string raw = bytes_of_values<T>({value}, big_);
    bytes_.replace(at, raw.size(), raw);
  }
  Nifti& real(std::size_t at_1, std::size_t at_2, std::size_t i, double value) {
    if (version_ == 1)
      put<float>(at_1 + 4 * i, static_cast<float>(value));
    else
      put<double>(at_2 + 8 * i, value);
    return *this;
  }

  int version_;
  bool big_;
  std::string bytes_;
};

TEST(NiftiFiles, AreReadInBothVersionsAndByteOrders) {
  const std::vector<std::int16_t> values = typical_values<std::int16_t>();
  for (const int version : {1, 2}) {
    for (const bool big : {false, true}) {
      const std::string bytes = Nifti(version, big)
                                    .dims({2, 3, 4})
                                    .type(4)
                                    .pixdim(1, 0.5)
                                    .pixdim(2, -2)
                                    .pixdim(3, 3)
                                    .units(2)
                                    .sform({-0.5, 0, 0, 0, 0, 0, 3, 0, 0, 2, 0, 0})
                                    .with(bytes_of_values(values, big));
      for (const std::string& packed : {bytes, gzipped(bytes), bzip2ed(bytes)}) {
        const Volume volume = load_as_volume("a.nii", packed);
        EXPECT_EQ(volume.size, (std::array<int, 3>{2, 3, 4}));
        EXPECT_EQ(volume.spacing, (std::array<double, 3>{0.5, 2, 3}));
        EXPECT_EQ(values_of(volume), std::vector<double>(values.begin(), values.end()));
        EXPECT_EQ(volume.type, ScalarType::i16);
        EXPECT_EQ(volume.facts.unit, "mm");
        EXPECT_EQ(volume.facts.orientation, "LSA");
      }
    }
  }
}

TEST(NiftiFiles, ApplyTheirScale) {
  const auto scaled = [](double slope, double intercept) {
    return load_as_volume("a.nii", Nifti(1, false)
                                       .dims({3, 1, 1})
                                       .type(2)
                                       .scale(slope, intercept)
                                       .with(std::string("\0\1\2", 3)));
  };
  EXPECT_THAT(values_of(scaled(0.5, -1)), ElementsAre(-1, -0.5, 0));
  EXPECT_EQ(scaled(0.5, -1).type, ScalarType::f32);
  EXPECT_EQ(scaled(0, 7).type, ScalarType::u8) << "a slope of 0 means no scaling";
  EXPECT_EQ(scaled(1, 0).type, ScalarType::u8);
  EXPECT_THAT(scaled(2, 0).facts.notes, ElementsAre(HasSubstr("2·stored + 0")));
}

TEST(NiftiFiles, HaveComponents) {
  const std::string times = Nifti(1, false).dims({2, 1, 1, 3}).type(2).with("abcdef");
  EXPECT_THAT(values_of(load_as_volume("a.nii", times)), ElementsAre('a', 'b'));
  EXPECT_THAT(values_of(load_as_volume("a.nii", times, {.index = 2})), ElementsAre('e', 'f'));
  EXPECT_THROW((void)load_as_volume("a.nii", times, {.index = 3}), core::InputError);
  const std::string colours = Nifti(1, false).dims({2, 1, 1}).type(128).with("abcdef");
  EXPECT_THAT(values_of(load_as_volume("a.nii", colours, {.index = 1})), ElementsAre('b', 'e'));
  const std::string vectors =
      Nifti(1, false).dims({1, 1, 1, 1, 2}).type(16).with(bytes_of_values<float>({3, 4}, false));
  EXPECT_THAT(values_of(load_as_volume("a.nii", vectors, {.magnitude = true})), ElementsAre(5));
}

TEST(NiftiFiles, MayBePairs) {
  const TemporaryFolder folder;
  std::string header = Nifti(1, false).dims({2, 1, 1}).type(2).offset(1).with("").substr(0, 348);
  header.replace(344, 3, "ni1");
  folder.write("a.hdr", header);
  EXPECT_THAT([&] { (void)load_volume("a.hdr", {folder.path()}); },
              ThrowsMessage<core::InputError>(HasSubstr("the voxel file 'a.img' does not exist")));
  folder.write("a.img", "xAB");
  EXPECT_THAT(values_of(load_volume("a.hdr", {folder.path()})), ElementsAre('A', 'B'));
}

TEST(NiftiFiles, ReportTheCauseOfAnError) {
  const auto nifti = [] { return Nifti(1, false).dims({2, 1, 1}).type(2); };
  expect_volume_refused("a.nii", "short", "has only 5 bytes");
  expect_volume_refused("a.nii", std::string(400, 'x'),
                        "first 4 bytes do not contain a header size");
  expect_volume_refused("a.nii", nifti().with("A"), "need 2 bytes of data");
  expect_volume_refused("a.nii", nifti().type(32).with("AB"), "datatype 32 is not supported");
  expect_volume_refused("a.nii", nifti().dims({2, 1}).with("AB"),
                        "has 2 dimensions; expected 3 to 7");
  expect_volume_refused("a.nii", nifti().dims({2, 0, 1}).with("AB"), "size 0 along dimension 2");
  expect_volume_refused("a.nii", nifti().offset(100).with("AB"), "(vox_offset)");
  expect_volume_refused("a.nii", nifti().pixdim(1, std::nan("")).with("AB"), "spacing nan");
  expect_volume_refused("a.nii",
                        Nifti(2, false).dims({32767, 32767, 32767, 32767}).type(64).with(""), "");
  std::string analyze = nifti().with("AB");
  analyze.replace(344, 4, std::string(4, '\0'));
  expect_volume_refused("a.nii", analyze, "Analyze 7.5");
}

const std::string meta = "ObjectType = Image\nNDims = 3\nDimSize = 2 1 1\nElementSpacing = 1 2 3\n";

TEST(MetaImage, ReadsAllVariants) {
  EXPECT_EQ(load_as_volume("a.mha", meta + "ElementType = MET_UCHAR\nElementDataFile = LOCAL\nAB")
                .spacing,
            (std::array<double, 3>{1, 2, 3}));
  const std::string shorts = bytes_of_values<std::int16_t>({-3, 500}, true);
  const std::string head = meta + "ElementType = MET_SHORT\nBinaryDataByteOrderMSB = True\n";
  EXPECT_THAT(values_of(load_as_volume("a.mha", head + "ElementDataFile = LOCAL\n" + shorts)),
              ElementsAre(-3, 500));
  EXPECT_THAT(
      values_of(load_as_volume(
          "a.mha", head + "CompressedData = True\nElementDataFile = LOCAL\n" + gzipped(shorts))),
      ElementsAre(-3, 500));
  EXPECT_THAT(values_of(load_as_volume(
                  "a.mha", head + "BinaryData = False\nElementDataFile = LOCAL\n-3 500\n")),
              ElementsAre(-3, 500));
  const TemporaryFolder folder;
  folder.write("a.raw", "header" + shorts);
  folder.write("a.mhd", head +
                            "HeaderSize = -1\nTransformMatrix = 0 1 0 -1 0 0 0 0 1\n"
                            "ElementDataFile = a.raw\n");
  const Volume volume = load_volume("a.mhd", {folder.path()});
  EXPECT_THAT(values_of(volume), ElementsAre(-3, 500));
  EXPECT_EQ(volume.facts.orientation, "PRS");
  folder.write("b.raw", shorts.substr(0, 2));
  folder.write("c.raw", shorts.substr(2));
  folder.write("b.mhd", head + "ElementDataFile = LIST\nb.raw\nc.raw\n");
  EXPECT_THAT(values_of(load_volume("b.mhd", {folder.path()})), ElementsAre(-3, 500));
}

TEST(MetaImage, HasChannels) {
  const std::string channels = meta +
                               "ElementNumberOfChannels = 3\nElementType = MET_UCHAR_ARRAY\n"
                               "ElementDataFile = LOCAL\nabcdef";
  EXPECT_THAT(values_of(load_as_volume("a.mha", channels, {.index = 1})), ElementsAre('b', 'e'));
  const std::string times =
      "NDims = 4\nDimSize = 2 1 1 2\nElementSpacing = 1 1 1 9\nElementType = MET_UCHAR\n"
      "ElementDataFile = LOCAL\nabcd";
  EXPECT_THAT(values_of(load_as_volume("a.mha", times, {.index = 1})), ElementsAre('c', 'd'));
}

TEST(MetaImage, ReportsTheLineOfAnError) {
  expect_volume_refused("a.mha", meta, "no line 'ElementDataFile = …'");
  expect_volume_refused("a.mha", meta + "ElementDataFile = LOCAL\nAB", "no line 'ElementType = …'");
  expect_volume_refused("a.mha", meta + "ElementType = MET_WORD\nElementDataFile = LOCAL\nAB",
                        ":5: type 'MET_WORD' is not supported");
  expect_volume_refused("a.mha", "NDims = 2\nDimSize = 2 1\nElementDataFile = LOCAL\n",
                        ":1: the volume has 2 dimensions");
  expect_volume_refused("a.mha", "ObjectType = Mesh\nElementDataFile = LOCAL\n",
                        ":1: the object type 'Mesh' is not a volume");
  expect_volume_refused("a.mha", meta + "ElementDataFile =\n", "the data file '' does not exist");
  expect_volume_refused("a.mha",
                        meta +
                            "TransformMatrix = 1 1 0 0 1 0 0 0 1\nElementType = MET_UCHAR\n"
                            "ElementDataFile = LOCAL\nAB",
                        "not perpendicular");
}

std::string vti(const std::string& root, const std::string& array, const std::string& after = "") {
  return "<?xml version=\"1.0\"?>\n<!-- > -->\n<VTKFile type=\"ImageData\" " + root +
         ">\n<ImageData WholeExtent=\"3 4 0 0 0 0\" Spacing=\"1 2 3\">\n<Piece Extent=\"3 4 0 0 0 "
         "0\">"
         "<PointData Scalars=\"s\"><DataArray type=\"Int16\" Name=\"other\" format=\"ascii\">1 2"
         "</DataArray><DataArray type=\"Int16\" Name=\"s\" " +
         array + "</DataArray></PointData></Piece></ImageData>" + after + "</VTKFile>\n";
}

TEST(VtkXml, ReadsAllVariants) {
  const auto expect = [](const std::string& text) {
    const Volume volume = load_as_volume("a.vti", text);
    EXPECT_THAT(values_of(volume), ElementsAre(-3, 500)) << text;
    EXPECT_EQ(volume.spacing, (std::array<double, 3>{1, 2, 3}));
    EXPECT_THAT(volume.facts.notes, ElementsAre(HasSubstr("only the array 's' is drawn")));
  };
  const std::string little = "byte_order=\"LittleEndian\"";
  expect(vti(little, "format=\"ascii\">-3 500"));
  // The block begins with its size, 4 bytes (04000000), followed by the data FDFF F401.
  expect(vti(little, "format=\"binary\">\n  BAAAAP3/9AE=\n"));
  expect(vti("byte_order=\"BigEndian\"", "format=\"binary\">AAAABP/9AfQ="));
  expect(vti(little + " header_type=\"UInt64\"", "format=\"binary\">BAAAAAAAAAD9//QB"));
  expect(vti(little, "format=\"appended\" offset=\"0\"/><DataArray>",
             "<AppendedData encoding=\"base64\">\n_BAAAAP3/9AE=</AppendedData>"));
  const std::string raw =
      bytes_of_values<std::uint32_t>({4}, false) + bytes_of_values<std::int16_t>({-3, 500}, false);
  expect(vti(little, "format=\"appended\" offset=\"2\"/><DataArray>",
             "<AppendedData encoding=\"raw\"> _xx" + raw + "</AppendedData>"));
  // The data are compressed in two blocks of 2 bytes each.
  std::string blocks[2];
  for (int i = 0; i < 2; ++i) {
    const std::string plain = raw.substr(4 + static_cast<std::size_t>(i) * 2, 2);
    std::array<Bytef, 64> packed{};
    uLongf size = packed.size();
    ASSERT_EQ(compress(packed.data(), &size, reinterpret_cast<const Bytef*>(plain.data()), 2),
              Z_OK);
    blocks[i].assign(reinterpret_cast<const char*>(packed.data()), size);
  }
  const auto size_of = [&](int i) { return static_cast<std::uint32_t>(blocks[i].size()); };
  expect(vti(little + " compressor=\"vtkZLibDataCompressor\"",
             "format=\"appended\" offset=\"0\"/><DataArray>",
             "<AppendedData encoding=\"raw\">_" +
                 bytes_of_values<std::uint32_t>({2, 2, 0, size_of(0), size_of(1)}, false) +
                 blocks[0] + blocks[1] + "</AppendedData>"));
}

TEST(VtkXml, ReportsTheCauseOfAnError) {
  const std::string little = "byte_order=\"LittleEndian\"";
  expect_volume_refused("a.vti", "<VTKFile type=\"PolyData\"></VTKFile>",
                        "expected <VTKFile type=\"Image");
  expect_volume_refused("a.vti", "<VTKFile", "a tag is not closed");
  expect_volume_refused("a.vti", vti(little, "format=\"ascii\">-3"), "need 4 bytes of data");
  expect_volume_refused("a.vti", vti(little, "format=\"ascii\">-3 x"),
                        "a value of type i16, found 'x'");
  expect_volume_refused("a.vti", vti(little, "format=\"binary\">BAAAAP3"),
                        "in the middle of a group of four");
  expect_volume_refused(
      "a.vti", vti(little + " compressor=\"vtkLZ4DataCompressor\"", "format=\"binary\">BA=="),
      "with the compressor ZLib");
  expect_volume_refused("a.vti",
                        vti(little + " compressor=\"vtkZLibDataCompressor\"",
                            "format=\"binary\">/////////////////////w=="),
                        "invalid block sizes");
  expect_volume_refused("a.vti", vti(little, "format=\"appended\" offset=\"0\"/><DataArray>"),
                        "expected <AppendedData>");
}

TEST(VtkLegacy, ReadsAllVariants) {
  const auto file = [](const std::string& kind, const std::string& data) {
    return "# vtk DataFile Version 3.0\ntitle\n" + kind +
           "\nDATASET STRUCTURED_POINTS\n"
           "DIMENSIONS 2 1 1\nSPACING 1 2 3\nORIGIN 0 0 0\nPOINT_DATA 2\n" +
           data;
  };
  const std::string shorts = bytes_of_values<std::int16_t>({-3, 500}, true);
  const Volume volume = load_as_volume(
      "a.vtk",
      file("BINARY", "SCALARS s short 1\nLOOKUP_TABLE default\n" + shorts + "\nMETADATA\n"));
  EXPECT_THAT(values_of(volume), ElementsAre(-3, 500));
  EXPECT_EQ(volume.spacing, (std::array<double, 3>{1, 2, 3}));
  EXPECT_THAT(values_of(load_as_volume(
                  "a.vtk", file("ASCII", "SCALARS s short\nLOOKUP_TABLE default\n-3 500\n"))),
              ElementsAre(-3, 500));
  EXPECT_THAT(values_of(load_as_volume("a.vtk", file("ASCII", "VECTORS v float\n3 4 0 0 0 1\n"),
                                       {.magnitude = true})),
              ElementsAre(5, 1));
  EXPECT_THAT(values_of(load_as_volume("a.vtk", file("ASCII", "FIELD f 1\ns 1 2 int\n7 8\n"))),
              ElementsAre(7, 8));
  expect_volume_refused("a.vtk", file("ASCII", "SCALARS s bit\n1 1\n"),
                        "type 'bit' is not supported");
  expect_volume_refused("a.vtk", file("BINARY", "SCALARS s short\nLOOKUP_TABLE default\nab"),
                        "need 4 bytes");
  expect_volume_refused("a.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n",
                        ":4: expected DATASET STRUCTURED_POINTS, found 'dataset polydata'");
}

TEST(RawVoxelFiles, StateTheirSizeInTheName) {
  const TemporaryFolder folder;
  folder.write("a:b.raw", "hh" + bytes_of_values<std::uint16_t>({258, 7}, true));
  const auto load_as = [&](const std::string& spec) {
    return load_volume("a:b.raw:" + spec, {folder.path()});
  };
  const Volume volume = load_as("2x1x1:u16:1x2x0.5:skip=2:big");
  EXPECT_THAT(values_of(volume), ElementsAre(258, 7));
  EXPECT_EQ(volume.spacing, (std::array<double, 3>{1, 2, 0.5}));
  EXPECT_THAT(values_of(load_as("1x1x1:uint16:components=2:skip=2:little")), ElementsAre(513));
  EXPECT_TRUE(is_present("a:b.raw:2x1x1:u16", {folder.path()}));
  EXPECT_FALSE(is_present("c.raw:2x1x1:u16", {folder.path()}));
  for (const char* broken : {"2x1x1", "2x1x1:u17", "0x1x1:u8", "2x1x1:u8:middle", "2x1x1:u8:1x0x1",
                             "2x1x1:u8:skip=x", "2x1x1:u8:components=0", "3x1x1:u16:skip=2"}) {
    EXPECT_THROW((void)load_as(broken), core::InputError) << broken;
  }
}

TEST(NrrdComponents, AreAnAxisOfFour) {
  const auto nrrd = [](const std::string& fields, const std::string& data) {
    return "NRRD0004\ntype: uint8\nencoding: raw\ndimension: 4\n" + fields + "\n\n" + data;
  };
  const std::string first = nrrd("sizes: 3 2 1 1\nkinds: RGB-color domain domain domain", "abcdef");
  EXPECT_THAT(values_of(load_as_volume("a.nrrd", first, {.index = 1})), ElementsAre('b', 'e'));
  const std::string last = nrrd(
      "sizes: 2 1 1 3\nkinds: domain domain domain time\n"
      "spacings: 1 2 3 nan",
      "abcdef");
  EXPECT_THAT(values_of(load_as_volume("a.nrrd", last, {.index = 1})), ElementsAre('c', 'd'));
  EXPECT_EQ(load_as_volume("a.nrrd", last).spacing, (std::array<double, 3>{1, 2, 3}));
  const std::string middle =
      nrrd("sizes: 2 2 1 2\nspace directions: (1,0,0) none (0,2,0) (0,0,3)", "abcdefgh");
  EXPECT_THAT(values_of(load_as_volume("a.nrrd", middle, {.index = 1})),
              ElementsAre('c', 'd', 'g', 'h'));
  expect_volume_refused("a.nrrd", nrrd("sizes: 2 2 2 2", std::string(16, 'a')),
                        "expected 3 axes, or 4");
}

TEST(WideIntegers, BecomeTheSmallestSufficientType) {
  const auto type_of = [](const std::vector<std::int64_t>& values) {
    return load_as_volume("a.nrrd",
                          "NRRD0004\ntype: int64\nendian: little\ndimension: 3\nencoding: raw\n"
                          "sizes: 2 1 1\n\n" +
                              bytes_of_values(values, false));
  };
  EXPECT_EQ(type_of({0, 255}).type, ScalarType::u8);
  EXPECT_EQ(type_of({-128, 127}).type, ScalarType::i8);
  EXPECT_EQ(type_of({0, 65535}).type, ScalarType::u16);
  EXPECT_EQ(type_of({-1, 32767}).type, ScalarType::i16);
  EXPECT_EQ(type_of({0, 1 << 24}).type, ScalarType::f32);
  EXPECT_EQ(type_of({0, (1 << 24) + 1}).type, ScalarType::f64);
  EXPECT_THAT(values_of(type_of({-1, 32767})), ElementsAre(-1, 32767));
  EXPECT_EQ(type_of({-1, 32767}).facts.value_type, "i64");
}

// Besides a row in the table, a new format needs seeds, a second reader and documentation. Reports
// what is missing.
template <typename Format>
void expect_complete(std::span<const Format> formats, const std::string& seeds) {
  const std::filesystem::path root = TRIPTYCH_SOURCE_FOLDER;
  std::ifstream in(root / "docs/data.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  std::ifstream second(root / "tests/readers/second_readers.py");
  const std::string script{std::istreambuf_iterator<char>(second), {}};
  std::set<std::string> seeded;
  for (const auto& entry : std::filesystem::directory_iterator(root / "tests/fuzz/seeds" / seeds)) {
    std::ifstream seed(entry.path(), std::ios::binary);
    std::string line;
    std::getline(seed, line);
    seeded.insert(line);
  }
  for (const Format& format : formats) {
    SCOPED_TRACE(format.name);
    const std::string ending(split_words(format.endings).front());
    EXPECT_TRUE(seeded.contains(ending.substr(1)))
        << "expected a file in tests/fuzz/seeds/" << seeds << " whose first line is the ending";
    EXPECT_THAT(script, HasSubstr("\"" + ending + "\"")) << "tests/readers/second_readers.py";
    for (const std::string_view each : split_words(format.endings)) {
      EXPECT_EQ(each, lower_case(each));
      EXPECT_THAT(page, HasSubstr("`" + std::string(each) + "`")) << "docs/data.md";
    }
  }
}

TEST(FormatTables, HaveSeedsSecondReadersAndDocumentation) {
  expect_complete(volume_formats(), "volumes");
  expect_complete(particle_formats(), "particles");
}

TEST(FormatAdvice, NamesTheNearestFormat) {
  expect_volume_refused("a.dcm", "x", "dcm2niix -o . FOLDER");
  expect_volume_refused("a.xyzzy", "x", "expected .nrrd .nhdr .nii");
  EXPECT_THAT(particle_advice(".xtc", ""), HasSubstr("gmx trjconv"));
  EXPECT_THAT(particle_advice("", ""), HasSubstr("the file name has no extension"));
  EXPECT_THAT(particle_advice("", ""), HasSubstr("expected .pdb"));
  expect_volume_refused("a", "x", "the file name has no extension");
}

TEST(FormatAdvice, NamesTheOtherSuite) {
  expect_volume_refused("a.pdb", "x", "triptych render particles --set data=FILE");
  expect_volume_refused("a", "ITEM: TIMESTEP\n", "format LAMMPS dump");
  EXPECT_THAT(particle_advice(".nii", ""), HasSubstr("triptych render volume --set data=FILE"));
  EXPECT_THAT(particle_advice("", "NRRD0004\n"), HasSubstr("format NRRD"));
}

}  // namespace
}  // namespace triptych::scene
