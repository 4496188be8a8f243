#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "scene/generators.hpp"
#include "scene/volume.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::scene {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr const char* tiny =
    "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1 1 2\nencoding: raw\n\nAB";

TEST(LoadVolume, Generates) {
  const Volume cube = load_volume("generate:mandelbulb:6");
  EXPECT_EQ(cube.voxels, generate_volume("mandelbulb", {6, 6, 6}).voxels);
  EXPECT_EQ(cube.name, "generate:mandelbulb:6");
  EXPECT_EQ(load_volume("generate:uniform_box:3x4x5").size, (std::array<int, 3>{3, 4, 5}));
}

TEST(LoadVolume, RejectsMalformedGeneratorStrings) {
  for (const char* data :
       {"generate:mandelbulb", "generate:mandelbulb:", "generate:mandelbulb:x",
        "generate:mandelbulb:4x4", "generate:mandelbulb:4x4x4x4", "generate:mandelbulb:4x4x",
        "generate:mandelbulb:4.5", "generate:mandelbulb:99999999999", "generate::4",
        "generate:", "generate:nothing:4", "generate:mandelbulb:-4"}) {
    EXPECT_THROW((void)load_volume(data), core::InputError) << data;
  }
}

TEST(LoadVolume, SearchesTheFoldersInOrder) {
  const TemporaryFolder first;
  const TemporaryFolder second;
  second.write("a.nrrd", tiny);
  const Volume volume = load_volume("a.nrrd", {first.path(), second.path()});
  EXPECT_EQ(volume.name, "a.nrrd");
  EXPECT_EQ(volume.value(1), 'B');
  EXPECT_EQ(load_volume((second.path() / "a.nrrd").string()).value(0), 'A');
  EXPECT_TRUE(is_present("a.nrrd", {first.path(), second.path()}));
  EXPECT_FALSE(is_present("a.nrrd", {first.path()}));
  EXPECT_FALSE(is_present(""));
  EXPECT_FALSE(is_present(first.path().string())) << "a folder is not a volume";
  EXPECT_TRUE(is_present("generate:mandelbulb:4"));
}

TEST(LoadVolume, DistinguishesMissingFromUnknownFiles) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { (void)load_volume("none.nrrd", {folder.path()}); },
              ThrowsMessage<core::IoError>(
                  testing::AllOf(HasSubstr("none.nrrd"), HasSubstr(folder.path().string()))));
  folder.write("a.tiff", "x");
  EXPECT_THAT(
      [&] { (void)load_volume("a.tiff", {folder.path()}); },
      ThrowsMessage<core::InputError>(HasSubstr("the nearest supported format is raw voxels")));
}

TEST(LoadVolume, DetectsFormatsByExtension) {
  const TemporaryFolder folder;
  folder.write("a.NRRD", tiny);
  EXPECT_EQ(load_volume("a.NRRD", {folder.path()}).voxel_count(), 2U);
  folder.write("a.dat", "ObjectFileName: a.raw\nResolution: 1 1 2\nFormat: UCHAR\n");
  folder.write("a.raw", "CD");
  EXPECT_EQ(load_volume("a.dat", {folder.path()}).value(0), 'C');
}

}  // namespace
}  // namespace triptych::scene
