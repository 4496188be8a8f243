// Reads real volumes from the folder that TRIPTYCH_DATA names (see docs/data.md). The expected
// sizes, types and ranges come from the description of the data, which was created with another
// reader.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "scene/volume.hpp"

namespace triptych::scene {
namespace {

struct Facts {
  std::array<int, 3> size;
  ScalarType type;
  std::array<double, 3> spacing;
  double lo;
  double hi;
};

const std::map<std::string, Facts>& known_facts() {
  static const std::map<std::string, Facts> facts{
      {"sim_hurricane_125x125x25_f32.nrrd",
       {{125, 125, 25}, ScalarType::f32, {4.0080321286, 4.0080321286, 4.0408163266}, 0, 76.56533}},
      {"ct_headphantom_175x248x58_u8.nrrd",
       {{175, 248, 58}, ScalarType::u8, {0.8125, 0.8125, 2.3970494}, 0, 255}},
      {"ct_tooth_103x94x161_u16.nrrd", {{103, 94, 161}, ScalarType::u16, {1, 1, 1}, 0, 1300}},
      {"cryoem_betagal_100x100x100_f32.nrrd",
       {{100, 100, 100}, ScalarType::f32, {3.54, 3.54, 3.54}, -0.05296945, 0.196958}},
      {"mri_head_160x232x160_u8.nrrd",
       {{160, 232, 160}, ScalarType::u8, {1, 0.898437, 0.898437}, 0, 255}},
      {"ct_stent_128x128x256_i16.nrrd", {{128, 128, 256}, ScalarType::i16, {1, 1, 1}, 0, 2000}},
      {"ct_bonsai_256x256x256_u8.nrrd", {{256, 256, 256}, ScalarType::u8, {1, 1, 1}, 0, 255}},
  };
  return facts;
}

TEST(RealData, EveryVolumeLoadsAsDescribed) {
  const char* root = std::getenv("TRIPTYCH_DATA");
  if (root == nullptr) GTEST_SKIP() << "TRIPTYCH_DATA does not name a folder of data";
  int described = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(root) / "volumes")) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    Volume volume = load_volume(name, {entry.path().parent_path()});
    EXPECT_EQ(volume.voxels.size(), volume.voxel_count() * bytes_of(volume.type));
    const auto found = known_facts().find(name);
    if (found == known_facts().end()) continue;
    ++described;
    const Facts& facts = found->second;
    EXPECT_EQ(volume.size, facts.size);
    EXPECT_EQ(volume.type, facts.type);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_DOUBLE_EQ(volume.spacing.at(axis), facts.spacing.at(axis));
    }
    // The description states seven digits.
    EXPECT_NEAR(volume.range_lo, facts.lo, 1e-7 * std::max(1.0, facts.hi));
    EXPECT_NEAR(volume.range_hi, facts.hi, 1e-7 * std::max(1.0, facts.hi));
    const VoxelFormat format = lossless_format(volume.type);
    EXPECT_EQ(encode(std::move(volume), format).hash.size(), 32U);
  }
  EXPECT_GT(described, 0) << "none of the files is a known one";
}

}  // namespace
}  // namespace triptych::scene
