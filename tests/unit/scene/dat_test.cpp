#include "scene/dat.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "raw_files.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::scene {
namespace {

using test::TemporaryFolder;
using testing::StartsWith;
using testing::ThrowsMessage;

template <typename T>
void expect_reads(const std::string& format, ScalarType type) {
  const TemporaryFolder folder;
  const std::vector<T> values = typical_values<T>();
  for (const bool big : {false, true}) {
    folder.write("a.raw", bytes_of_values(values, big));
    const Volume volume = read_dat(
        folder.write("a.dat",
                     "ObjectFileName: a.raw\nTaggedFileName: ---\nResolution:  2 3\t4\n"
                     "SliceThickness: 1 0.5 2\nFormat: " +
                         format +
                         "\nNbrTags: 0\nObjectType: TEXTURE_VOLUME_OBJECT\nObjectModel: RGBA\n"
                         "GridType: EQUIDISTANT\n" +
                         (big ? "Endianness: BIG\n" : "")));
    EXPECT_EQ(volume.type, type);
    EXPECT_EQ(volume.size, (std::array<int, 3>{2, 3, 4}));
    EXPECT_EQ(volume.spacing, (std::array<double, 3>{1, 0.5, 2}));
    ASSERT_EQ(volume.voxel_count(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(volume.value(i), static_cast<double>(values[i])) << format << ' ' << i;
    }
  }
}

TEST(Dat, ReadsEveryFormatInBothByteOrders) {
  expect_reads<std::uint8_t>("UCHAR", ScalarType::u8);
  expect_reads<std::int8_t>("CHAR", ScalarType::i8);
  expect_reads<std::uint16_t>("USHORT", ScalarType::u16);
  expect_reads<std::int16_t>("short", ScalarType::i16);
  expect_reads<float>("FLOAT", ScalarType::f32);
  expect_reads<double>("DOUBLE", ScalarType::f64);
}

TEST(Dat, SpacingIsOneUnlessStated) {
  const TemporaryFolder folder;
  folder.write("a.raw", "AB");
  const Volume volume = read_dat(
      folder.write("a.dat", "\r\nFORMAT:UCHAR\r\nresolution: 1 1 2\r\nobjectfilename: a.raw"));
  EXPECT_EQ(volume.spacing, (std::array<double, 3>{1, 1, 1}));
  EXPECT_EQ(volume.value(1), 'B');
}

TEST(Dat, BrokenFilesAreReportedWithTheirLine) {
  const TemporaryFolder folder;
  folder.write("a.raw", "AB");
  const std::string start = "ObjectFileName: a.raw\nResolution: 1 1 2\n";
  const auto expect = [&](const std::string& text, const std::string& message) {
    const auto file = folder.write("a.dat", text);
    EXPECT_THAT([&] { (void)read_dat(file); },
                ThrowsMessage<core::InputError>(StartsWith(file.string() + message)))
        << text;
  };
  expect(start, ": the line 'Format: …' is missing");
  expect("", ": the line 'Resolution: …' is missing");
  expect("Resolution: 1 1 2\nFormat: UCHAR\n", ": the line 'ObjectFileName: …' is missing");
  expect(start + "Format: LONG\n", ":3: unknown format 'LONG'; expected UCHAR");
  expect(start + "Format UCHAR\n", ":3: expected 'Key: value'");
  expect(start + "Format: UCHAR\nSliceThicknes: 1 1 1\n", ":4: unknown key 'SliceThicknes'");
  expect(start + "Format: UCHAR\n\x1b[2J: 1\n", ":4: unknown key '\uFFFD[2J'; expected");
  expect(start + "Format: UCHAR\nFormat: UCHAR\n", ":4: key 'format' is given twice");
  expect(start + "Format: UCHAR\nSliceThickness: 1 nan 1\n", ":4: spacing nan");
  expect(start + "Format: UCHAR\nSliceThickness: 1 1 0.7e30\n",
         ":4: spacing 7e+29 is out of range for an axis of 2 voxels");
  expect(start + "Format: UCHAR\nEndianness: MIDDLE\n", ":4: unknown endianness 'MIDDLE'");
  expect(start + "Format: USHORT\n",
         ":2: 1 x 1 x 2 voxels of u16 need 4 bytes of data, but a.raw hol");
  expect("ObjectFileName: a.raw\nFormat: UCHAR\nResolution: 1 1 1\n",
         ":3: 1 x 1 x 1 voxels of u8 nee");
  expect("ObjectFileName: b.raw\nFormat: UCHAR\nResolution: 1 1 2\n",
         ":1: the data file 'b.raw' does not exist");
  expect("ObjectFileName: a.raw\nFormat: UCHAR\nResolution: 1 0 2\n", ":3: size '0' along axis 1");
}

}  // namespace
}  // namespace triptych::scene
