#include "scene/nrrd.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/random.hpp"
#include "raw_files.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::scene {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

template <typename T>
void expect_values(const Volume& volume, ScalarType type, const std::vector<T>& values) {
  EXPECT_EQ(volume.type, type);
  EXPECT_EQ(volume.size, (std::array<int, 3>{2, 3, 4}));
  ASSERT_EQ(volume.voxel_count(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(volume.value(i), static_cast<double>(values[i])) << i;
  }
  EXPECT_EQ(volume.range_lo, static_cast<double>(*std::min_element(values.begin(), values.end())));
  EXPECT_EQ(volume.range_hi, static_cast<double>(*std::max_element(values.begin(), values.end())));
}

// Tests every spelling of a type in both byte orders, uncompressed and with gzip, and with attached
// and detached headers.
template <typename T>
void expect_reads(ScalarType type, const std::vector<std::string>& spellings) {
  const TemporaryFolder folder;
  const std::vector<T> values = typical_values<T>();
  for (const std::string& spelling : spellings) {
    for (const bool big : {false, true}) {
      for (const std::string encoding : {"raw", "gzip", "gz"}) {
        const std::string plain = bytes_of_values(values, big);
        const std::string data = encoding == "raw" ? plain : gzipped(plain);
        const std::string header =
            "NRRD0004\n# made for a test\ntype: " + spelling +
            "\ndimension: 3\nsizes: 2 3 4\nendian: " + (big ? "big" : "little") +
            "\nencoding: " + encoding + "\n";
        SCOPED_TRACE(header);
        expect_values(read_nrrd(folder.write("a.nrrd", header + "\n" + data)), type, values);
        folder.write("a.bin", data);
        expect_values(read_nrrd(folder.write("a.nhdr", header + "data file: a.bin\n")), type,
                      values);
      }
    }
  }
}

TEST(Nrrd, ReadsEveryTypeOrderAndEncoding) {
  expect_reads<std::int8_t>(ScalarType::i8, {"signed char", "int8", "int8_t"});
  expect_reads<std::uint8_t>(ScalarType::u8,
                             {"uchar", "unsigned char", "uint8", "uint8_t", "UINT8"});
  expect_reads<std::int16_t>(ScalarType::i16, {"short", "short int", "signed short",
                                               "signed short int", "int16", "int16_t"});
  expect_reads<std::uint16_t>(
      ScalarType::u16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"});
  expect_reads<float>(ScalarType::f32, {"float"});
  expect_reads<double>(ScalarType::f64, {"double"});
}

const std::string minimal = "NRRD0005\ntype: uint8\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n";

Volume read_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_nrrd(folder.write("a.nrrd", text));
}

TEST(Nrrd, SpacingIsOneUnlessStated) {
  EXPECT_EQ(read_text(minimal + "\nAB").spacing, (std::array<double, 3>{1, 1, 1}));
  EXPECT_EQ(read_text(minimal + "spacings: 0.5 1e-3 +4\n\nAB").spacing,
            (std::array<double, 3>{0.5, 1e-3, 4}));
}

TEST(Nrrd, SpaceDirectionsGiveTheLengths) {
  EXPECT_EQ(read_text(minimal + "space: left-posterior-superior\n"
                                "space directions: (0.5,0,0) (0,-2,0) (0,0,3)\n"
                                "space origin: (0,0,0)\n\nAB")
                .spacing,
            (std::array<double, 3>{0.5, 2, 3}));
  const Volume turned = read_text(minimal +
                                  "space dimension: 3\n"
                                  "space directions: ( 3, 4, 0 )  (-0.8,0.6,0)(0,0,2)\n\nAB");
  EXPECT_NEAR(turned.spacing[0], 5, 1e-15);
  EXPECT_NEAR(turned.spacing[1], 1, 1e-15);
}

// If the header does not state the spacing, it follows from the ends of the axes. Like the
// reference library of the format (Teem), the reader assumes cell-centred samples by default.
TEST(Nrrd, SpacingFollowsFromWhereAxesBeginAndEnd) {
  std::string head = minimal;
  head.replace(head.find("2 1 1"), 5, "2 3 1");
  const auto spacing = [&](const std::string& fields) {
    return read_text(head + fields + "\n\nABCDEF").spacing;
  };
  const std::string ends = "axis mins: 1 -3 0\naxismaxs: 2 3 4";
  using Lengths = std::array<double, 3>;
  EXPECT_EQ(spacing(ends), (Lengths{0.5, 2, 4}));
  EXPECT_EQ(spacing(ends + "\ncenterings: cell ??? none"), (Lengths{0.5, 2, 4}));
  EXPECT_EQ(spacing(ends + "\ncenters: Node node cell"), (Lengths{1, 3, 4}));
  EXPECT_EQ(spacing("axis mins: 2 3 4\naxis maxs: 1 -3 0"), (Lengths{0.5, 2, 4}))
      << "the axes run backwards";
  EXPECT_EQ(spacing(ends + "\nspacings: 7 8 9"), (Lengths{7, 8, 9}));
  EXPECT_EQ(spacing(ends + "\nspace directions: (7,0,0) (0,8,0) (0,0,9)"), (Lengths{7, 8, 9}));
  EXPECT_EQ(spacing("axis mins: 1 -3 0"), (Lengths{1, 1, 1}))
      << "without maxs, the length is unknown";
  EXPECT_EQ(spacing("axis mins: nan nan nan\naxis maxs: NaN nan nan"), (Lengths{1, 1, 1}));
}

TEST(Nrrd, AllowsWhatTheFormatAllows) {
  const Volume volume = read_text(
      "NRRD0004\r\n# comment\r\nContent: a: b\r\nTYPE: unsigned char\r\ndimension: 3\r\n"
      "sizes: 2 1 1\r\ncenters: cell cell cell\r\nlabels: \"x\" \"y\" \"z\"\r\nunits: \"mm\" \"\" "
      "\"\"\r\n"
      "kinds: space space space\r\nkey with blanks:=value: with colon\r\nencoding:raw\r\n"
      "sample units: HU\r\n\r\nAB");
  EXPECT_EQ(volume.value(0), 'A');
  EXPECT_EQ(volume.value(1), 'B');
}

TEST(Nrrd, AxesMustBeSpatial) {
  for (const char* kinds : {"domain domain domain", "space Space none", "??? ??? ???"}) {
    EXPECT_EQ(read_text(minimal + "kinds: " + kinds + "\n\nAB").value(0), 'A') << kinds;
  }
}

TEST(Nrrd, DataFileNamesMayContainAPercentSign) {
  const TemporaryFolder folder;
  for (const std::string name : {"50%dose.raw", "at 50% 1 2", "%d 1 2"}) {
    folder.write(name, "AB");
    EXPECT_EQ(read_nrrd(folder.write("a.nhdr", minimal + "data file: " + name + "\n")).value(1),
              'B')
        << name;
  }
}

TEST(Nrrd, ReadsDataFromSeveralFiles) {
  const TemporaryFolder folder;
  folder.write("s09.raw", "xA");
  folder.write("s10.raw", "xB");
  for (const char* files : {"s%02d.raw 9 10 1", "s%02d.raw 9 10 1 2", "LIST\ns09.raw\ns10.raw",
                            "LIST 2\ns09.raw\n\ns10.raw"}) {
    const Volume volume =
        read_nrrd(folder.write("a.nhdr", minimal + "byte skip: 1\ndata file: " + files + "\n"));
    EXPECT_EQ(volume.value(0), 'A') << files;
    EXPECT_EQ(volume.value(1), 'B') << files;
  }
  folder.write("s10.raw", "xBC");
  EXPECT_THAT(
      [&] {
        (void)read_nrrd(
            folder.write("a.nhdr", minimal + "byte skip: 1\ndata file: s%02d.raw 9 10 1\n"));
      },
      ThrowsMessage<core::InputError>(HasSubstr("s10.raw holds more (data after the end)")));
}

TEST(Nrrd, KeysMayHaveColonsAndHeadersMayBeLong) {
  EXPECT_EQ(read_text(minimal + "a:b:c:=\"x\"\n\nAB").value(1), 'B');
  const std::string pair = "key:=" + std::string(std::size_t{3} << 20, 'x') + "\n";
  EXPECT_EQ(read_text(minimal + pair + "\nAB").value(1), 'B');
}

TEST(Nrrd, SkipsLinesThenBytes) {
  EXPECT_EQ(read_text(minimal + "line skip: 2\nbyteskip: 3\n\none\ntwo\nxyzAB").value(0), 'A');
  EXPECT_EQ(read_text(minimal + "byte skip: -1\n\nany number of bytesAB").value(1), 'B');
  const TemporaryFolder folder;
  folder.write("a.bin", "a line\n" + gzipped("xyzAB"));
  std::string header = minimal;
  header.replace(header.find("raw"), 3, "gzip");
  const Volume volume =
      read_nrrd(folder.write("a.nhdr", header + "line skip: 1\nbyte skip: 3\ndata file: a.bin\n"));
  EXPECT_EQ(volume.value(0), 'A');
}

TEST(Nrrd, ReadsGzipOfSeveralMembers) {
  std::string header = minimal;
  header.replace(header.find("raw"), 3, "gzip");
  EXPECT_EQ(read_text(header + "\n" + gzipped("A") + gzipped("B")).value(1), 'B');
}

TEST(Nrrd, RangeIgnoresNonFiniteValues) {
  const float nan = std::nanf("");
  const float inf = std::numeric_limits<float>::infinity();
  const std::string header =
      "NRRD0004\ntype: float\ndimension: 3\nsizes: 4 1 1\nendian: little\nencoding: raw\n\n";
  const Volume some = read_text(header + bytes_of_values<float>({nan, -inf, 2, inf}, false));
  EXPECT_EQ(some.range_lo, 2);
  EXPECT_EQ(some.range_hi, 2);
  const Volume none = read_text(header + bytes_of_values<float>({nan, nan, inf, -inf}, false));
  EXPECT_EQ(none.range_lo, 0);
  EXPECT_EQ(none.range_hi, 0);
}

// A broken file, and the message expected after the file's name.
struct Broken {
  std::string text;
  std::string message;
};

void expect_rejected(const std::vector<Broken>& cases) {
  for (const auto& [text, message] : cases) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.nrrd", text);
    EXPECT_THAT([&] { (void)read_nrrd(file); },
                ThrowsMessage<core::InputError>(
                    AllOf(StartsWith(file.string() + message), Not(HasSubstr("\n")))))
        << text;
  }
}

// Returns a file whose header has `line` as its third line, followed by valid lines.
std::string with_line(const std::string& line) {
  std::string text = "NRRD0004\n# one\n" + line + "\n";
  for (const std::string other :
       {"type: uint8", "dimension: 3", "sizes: 2 1 1", "encoding: raw", "endian: little"}) {
    if (other.substr(0, other.find(':')) != line.substr(0, line.find(':'))) text += other + "\n";
  }
  return text + "\nAB";
}

TEST(Nrrd, BrokenHeadersAreReportedWithTheirLine) {
  expect_rejected({
      {"", ": the file is empty"},
      {"P5\n1 1\n", ":1: this is not an NRRD file"},
      {"NRRD0009\n", ":1: this is not an NRRD file"},
      {std::string("\0\1\2\3", 4), ":1: this is not an NRRD file"},
      {with_line("type: long"), ":3: type 'long' is not supported; expected int8"},
      {with_line("type: "), ":3: type '' is not supported"},
      {with_line("type: block"), ":3: type 'block' is not supported"},
      {with_line("dimension: 2"), ":3: the dimension is '2'; expected 3, or 4"},
      {with_line("dimension: three"), ":3: the dimension is 'three'"},
      {with_line("sizes: 2 1"), ":3: expected 3 sizes, got 2"},
      {with_line("sizes: 2 1 1 1"), ":3: expected 3 sizes, got 4"},
      {with_line("sizes: 2 0 1"), ":3: size '0' along axis 1; expected a whole number from 1"},
      {with_line("sizes: 2 1 -1"), ":3: size '-1' along axis 2"},
      {with_line("sizes: 2.5 1 1"), ":3: size '2.5' along axis 0"},
      {with_line("sizes: 99999999999999999999 1 1"),
       ":3: size '99999999999999999999' along axis 0"},
      {with_line("sizes: 2147483647 2147483647 2147483647"), ":3: 2147483647 x "},
      {with_line("spacings: 1 nan 1"), ":3: spacing nan; expected a positive, finite number"},
      {with_line("spacings: 1 inf 1"), ":3: spacing inf"},
      {with_line("spacings: 1 0 1"), ":3: spacing 0"},
      {with_line("spacings: 1 -2 1"), ":3: spacing -2"},
      {with_line("spacings: 1 1e-31 1"),
       ":3: spacing 1e-31 is out of range for an axis of 1 voxels"},
      {with_line("spacings: 1e31 1 1"),
       ":3: spacing 1e+31 is out of range for an axis of 2 voxels"},
      {with_line("spacings: 0.7e30 1 1"),
       ":3: spacing 7e+29 is out of range for an axis of 2 voxels"},
      {with_line("space directions: (0.7e30,0,0) (0,1,0) (0,0,1)"),
       ":3: spacing 7e+29 is out of range"},
      {with_line("spacings: 1 1"), ":3: expected 3 spacings, got 2"},
      {with_line("spacings: 1 1 one"), ":3: spacing 'one'"},
      {with_line("space directions: (1,0,0) (0,1,0)"), ":3: expected three vectors"},
      {with_line("space directions: none (0,1,0) (0,0,1)"), ":3: expected three vectors"},
      {with_line("space directions: (1,0) (0,1) (1,1)"),
       ":3: the vector has 2 numbers; expected 3"},
      {with_line("space directions: (1,0,0) (0,1,0) (0,0,nan)"),
       ":3: found 'nan'; expected a finite"},
      {with_line("space directions: (1,0,0) (0,0,0) (0,0,1)"), ":3: spacing 0"},
      {with_line("space directions: (1,0,0) (1,1,0) (0,0,1)"), ":3: axes 0 and 1 are not perpend"},
      {with_line("space directions: (1,0,0) (0,1,0) (0,0,1) 4"), ":3: unexpected ' 4'"},
      {with_line("kinds: RGB-color domain domain"),
       ":3: the kind 'RGB-color' of axis 0 is not spatial"},
      {with_line("kinds: domain domain scalar"),
       ":3: the kind 'scalar' of axis 2 is not spatial; expected domain"},
      {with_line("kinds: domain domain"), ":3: expected 3 kinds, got 2"},
      {with_line("encoding: xz"), ":3: encoding 'xz' is not supported; expected raw, gzip, bzip2"},
      {with_line("dimension: 4"), ":5: expected 4 sizes, got 3"},
      {with_line("encodng: raw"), ":3: unknown NRRD field 'encodng'"},
      {with_line(std::string(99, 'e') + ": raw"),
       ":3: unknown NRRD field '" + std::string(40, 'e') + "…'"},
      {with_line("encoding: r\x1b[2Jaw"), ":3: encoding 'r\uFFFD[2Jaw' is not supported"},
      {with_line("sizes: 2 1 \x1b[2J"), ":3: size '\uFFFD[2J' along axis 2"},
      {with_line("a line of nothing"), ":3: expected 'field: value', 'key:=value' or a comment"},
      {with_line("byte skip: -2"), ":3: found '-2'; expected a whole number, 0 or more, or -1"},
      {with_line("byte skip: x"), ":3: found 'x'"},
      {with_line("line skip: -1"), ":3: found '-1'; expected a whole number, 0 or more"},
      {with_line("line skip: 5"), ":3: 'line skip' is too large: a.nrrd has only 0 lines to skip"},
      {with_line("data file: nothing.raw"), ":3: the data file 'nothing.raw' does not exist"},
      {with_line("data file: LIST"), ": the header has no field 'type'"},
      {minimal + "data file: LIST\nnothing.raw\n",
       ":7: the data file 'nothing.raw' does not exist"},
      {minimal + "data file: LIST\n", ":6: expected the names of the data files after LIST"},
      {with_line("data file: slice%03d.raw 1 9 1"),
       ":3: the data file 'slice001.raw' does not exist"},
      {with_line("data file: slice %03d.raw 1 9 -1 2"), ":3: the pattern yields no file names"},
      {with_line("data file: slice%s.raw 1 9 1"), ":3: expected a pattern such as slice%03d.raw"},
      {"NRRD0004\ntype: uint8\ntype: uint8\n", ":3: field 'type' is given twice"},
      {minimal + "space directions: (1,0,0) (0,1,0) (0,0,1)\nspacings: 1 1 1\n\nAB",
       ":6: 'space directions' and 'spacings' are mutually exclusive"},
      {minimal + "axis mins: 0 0 0\naxis maxs: 1 1 0\n\nAB", ":7: spacing 0; expected"},
      {minimal + "axis mins: 0 0 0\naxis maxs: 1 1 nan\n\nAB", ":7: spacing nan; expected"},
      {minimal + "axis mins: 0 0 0\naxis maxs: 1 1\n\nAB",
       ":7: expected 3 values, one per axis; got 2"},
      {minimal + "axis mins: 0 0 x\naxis maxs: 1 1 1\n\nAB", ":6: found 'x'; expected a number"},
      {minimal + "axis mins: 0 0 0\naxis maxs: 1 1 1\ncenterings: cell mid cell\n\nAB",
       ":8: unknown centering 'mid' of axis 1; expected cell or node"},
      {minimal + "axis mins: 0 0 0\naxis maxs: 1 1 1\ncenterings: node node cell\n\nAB",
       ":7: axis 1 has only one node-centred sample"},
      {"NRRD0004\ntype: float\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n\n....",
       ":2: multi-byte values require the field 'endian'"},
      {"NRRD0004\ntype: float\ndimension: 3\nsizes: 1 1 1\nencoding: raw\nendian: up\n\n....",
       ":6: unknown byte order 'up'; expected little or big"},
      {minimal, ":5: the blank line between the header and the data is missing"},
  });
}

TEST(Nrrd, MissingFieldsAreReported) {
  for (const std::string field : {"type", "dimension", "sizes", "encoding"}) {
    std::string text;
    for (const std::string line :
         {"NRRD0004", "type: uint8", "dimension: 3", "sizes: 2 1 1", "encoding: raw", ""}) {
      if (!line.starts_with(field)) text += line + "\n";
    }
    expect_rejected({{text + "AB", ": the header has no field '" + field + "'"}});
  }
}

TEST(Nrrd, DataThatDoNotMatchTheSizesAreReported) {
  std::string gzip = minimal;
  gzip.replace(gzip.find("raw"), 3, "gzip");
  std::string huge = gzip;
  huge.replace(huge.find("2 1 1"), 5, "9999 9999 9999");
  expect_rejected({
      {minimal + "\nA",
       ":4: 2 x 1 x 1 voxels of u8 need 2 bytes of data, but a.nrrd holds 1 (trunc"},
      {minimal + "\n",
       ":4: 2 x 1 x 1 voxels of u8 need 2 bytes of data, but a.nrrd holds 0 (trunc"},
      {minimal + "\nABC",
       ":4: 2 x 1 x 1 voxels of u8 need 2 bytes of data, but a.nrrd holds 3 (data"},
      {minimal + "byte skip: 1\n\nAB",
       ":4: 2 x 1 x 1 voxels of u8 need 2 bytes of data, but a.nrrd"},
      {minimal + "byte skip: 9\n\nAB",
       ":4: 2 x 1 x 1 voxels of u8 need 2 bytes of data, but a.nrrd"},
      {minimal + "byte skip: -1\n\nA",
       ":4: 2 x 1 x 1 voxels of u8 need 2 bytes of data, but a.nrrd"},
      {gzip + "\n" + gzipped("A"),
       ":4: 2 x 1 x 1 voxels of u8 need 2 bytes of data, but the gzip "},
      {gzip + "\n" + gzipped("ABC"),
       ":4: 2 x 1 x 1 voxels of u8 need 2 bytes of data, but the gzip"},
      {huge + "\n" + gzipped("AB"),
       ":4: 9999 x 9999 x 9999 voxels of u8 need 999700029999 bytes of "},
  });
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// The header claims a size that gzip could produce in principle, but that is far larger than the
// actual data.
TEST(Nrrd, AClaimedSizeDoesNotAllocateMemory) {
  core::Random random(1);
  std::string bytes(std::size_t{1} << 20, '\0');
  for (char& byte : bytes)
    byte = static_cast<char>(static_cast<unsigned char>(random.uniform() * 256));
  std::string header = minimal;
  header.replace(header.find("raw"), 3, "gzip");
  header.replace(header.find("2 1 1"), 5, "1024 1024 1000");
  const std::string text = header + "\n" + gzipped(bytes);
  const std::uint64_t before = peak_memory_bytes();
  expect_rejected({{text,
                    ":4: 1024 x 1024 x 1000 voxels of u8 need 1048576000 bytes of data, but "
                    "the gzip stream in a.nrrd holds 1048576"}});
  EXPECT_LT(peak_memory_bytes() - before, std::uint64_t{300} << 20);
}

TEST(Nrrd, UnpackingIsLimited) {
  std::string header = minimal;
  header.replace(header.find("raw"), 3, "gzip");
  header.replace(header.find("2 1 1"), 5, "1024 1024 1025");
  expect_rejected({{header + "\n" + std::string(std::size_t{2} << 20, 'x'),
                    ": the file decompresses to more than 1073741824 bytes"}});
}

TEST(Nrrd, BrokenGzipStreamsAreBadInput) {
  std::string header = minimal;
  header.replace(header.find("raw"), 3, "gzip");
  header += "\n";
  const std::string good = gzipped("AB");
  std::string bad_sum = good;
  bad_sum[bad_sum.size() - 6] ^= 1;
  expect_rejected({
      {header + "not gzip", ": broken gzip stream: incorrect header check"},
      {header + good.substr(0, good.size() - 5), ": broken gzip stream: the data end prematurely"},
      {header + good.substr(0, 12), ": broken gzip stream: the data end prematurely"},
      {header, ": broken gzip stream: the data end prematurely"},
      {header + bad_sum, ": broken gzip stream: incorrect data check"},
      {header + good + "garbage", ": broken gzip stream: incorrect header check"},
      {header + good + std::string("\0x", 2),
       ": broken gzip stream: unexpected data after the zero padding"},
  });
}

TEST(Nrrd, ChangedBytesLeadToAVolumeOrATypedError) {
  const TemporaryFolder folder;
  const std::string good = minimal + "spacings: 1 1 1\n\nAB";
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const char c : {'\0', '\n', '9', '\xFF'}) {
      std::string text = good;
      text[i] = c;
      try {
        (void)read_nrrd(folder.write("a.nrrd", text));
      } catch (const core::InputError&) {
      }
    }
  }
}

}  // namespace
}  // namespace triptych::scene
