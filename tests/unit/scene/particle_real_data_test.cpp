// Reads real particle files from the folder that TRIPTYCH_DATA names (see docs/data.md). The
// expected counts, elements and extents come from the description of the data, which was created
// with other readers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "core/error.hpp"
#include "scene/particles.hpp"

namespace triptych::scene {
namespace {

struct ParticleFacts {
  std::size_t count;
  std::uint64_t frames;
  // The number of particles with each radius in the first frame.
  std::map<float, std::size_t> by_radius;
  // The bounds of the centres in the first frame.
  std::array<double, 3> lo;
  std::array<double, 3> hi;
  std::size_t kinds;
};

const std::map<std::string, ParticleFacts>& known_particle_facts() {
  // Mn and Ca have the default radius of unlisted elements; P and S have the radius 1.8.
  static const std::map<std::string, ParticleFacts> facts{
      {"crambin_1crn_327.pdb",
       {327,
        1,
        {{1.7F, 202}, {1.52F, 64}, {1.55F, 55}, {1.8F, 6}},
        {-3.097, -0.516, -7.422},
        {24.284, 20.937, 19.58},
        4}},
      {"polymer_1714x42.lammpstrj.gz",
       {1714, 42, {}, {51.044, 75.981, 75.977}, {109.045, 134.03, 133.99}, 3}},
      {"alloy_fcc_4000.lammpstrj", {4000, 2, {}, {0, 0, 0}, {33.59, 33.59, 33.59}, 3}},
      {"lectin_1vln_14520.pdb",
       {14520,
        1,
        {{1.7F, 9128}, {1.52F, 2944}, {1.55F, 2416}, {1.8F, 16}, {2.F, 16}},
        {-39.262, -43.169, -37.348},
        {89.877, 49.01, 105.038},
        6}},
      {"membrane_popc_63565.gro.gz",
       {63565,
        1,
        {{static_cast<float>(1.2 * 0.1), 40902},
         {static_cast<float>(1.52 * 0.1), 14049},
         {static_cast<float>(1.7 * 0.1), 8148},
         {static_cast<float>(1.55 * 0.1), 194},
         {static_cast<float>(1.8 * 0.1), 194},
         {static_cast<float>(2.27 * 0.1), 39},
         {static_cast<float>(1.75 * 0.1), 39}},
        {-0.571, -0.454, -0.054},
        {8.626, 8.662, 10.444},
        7}},
      {"ribosome_4v5a_290487.cif.gz",
       {290487,
        1,
        {{1.7F, 146343},
         {1.52F, 78846},
         {1.55F, 54612},
         {1.8F, 8978 + 222},
         {1.73F, 1482},
         {1.39F, 4}},
        {-199.431, -143.459, -125.601},
        {72.75, 247.151, 256.622},
        7}},
  };
  return facts;
}

void expect_facts(const std::string& name, const ParticleFacts& facts,
                  const std::vector<std::filesystem::path>& folders) {
  const ParticleSet set = load_particles(name, ColourKind::rgba8, folders);
  EXPECT_EQ(set.count(), facts.count);
  EXPECT_EQ(set.dropped, 0U);
  std::map<float, std::size_t> by_radius;
  std::array<double, 3> lo{1e30, 1e30, 1e30};
  std::array<double, 3> hi{-1e30, -1e30, -1e30};
  for (const auto& sphere : set.spheres) {
    ++by_radius[sphere[3]];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lo.at(axis) = std::min(lo.at(axis), static_cast<double>(sphere.at(axis)));
      hi.at(axis) = std::max(hi.at(axis), static_cast<double>(sphere.at(axis)));
    }
  }
  if (!facts.by_radius.empty()) {
    EXPECT_EQ(by_radius, facts.by_radius);
  } else {
    EXPECT_EQ(by_radius.size(), 1U) << "all types must have the same radius";
  }
  // The description states three decimals.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(lo.at(axis), facts.lo.at(axis), 1e-3);
    EXPECT_NEAR(hi.at(axis), facts.hi.at(axis), 1e-3);
  }
  EXPECT_EQ(std::set<std::uint32_t>(set.rgba8.begin(), set.rgba8.end()).size(), facts.kinds);
  const std::string last = name + "@" + std::to_string(facts.frames - 1);
  EXPECT_EQ(load_particles(last, ColourKind::intensity, folders).count(), facts.count);
  EXPECT_THROW(static_cast<void>(load_particles(name + "@" + std::to_string(facts.frames),
                                                ColourKind::rgba8, folders)),
               core::InputError);
}

TEST(RealData, EveryParticleFileLoadsAsDescribed) {
  const char* root = std::getenv("TRIPTYCH_DATA");
  if (root == nullptr) GTEST_SKIP() << "TRIPTYCH_DATA does not name a folder of data";
  int described = 0;
  const auto folder = std::filesystem::path(root) / "particles";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const auto found = known_particle_facts().find(name);
    if (found == known_particle_facts().end()) {
      EXPECT_GT(load_particles(name, ColourKind::rgba32, {folder}).count(), 0U);
      continue;
    }
    ++described;
    expect_facts(name, found->second, {folder});
  }
  EXPECT_GT(described, 0) << "none of the files is a known one";
}

}  // namespace
}  // namespace triptych::scene
