#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "scene/particles.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::scene {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::FloatEq;
using testing::HasSubstr;
using testing::ThrowsMessage;

using Sphere = std::array<float, 4>;

template <typename... T>
std::string pack(T... values) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
  return bytes;
}

std::uint8_t byte(int value) {
  return static_cast<std::uint8_t>(value);
}
std::uint16_t word(int value) {
  return static_cast<std::uint16_t>(value);
}

// Returns the bytes of one particle list: its vertex and colour types, `header`, and the particles
// in `data`.
std::string list(int version, int vertex, int colour, const std::string& header,
                 std::uint64_t count, const std::string& data) {
  std::string bytes = pack(byte(vertex), byte(colour)) + header + pack(count);
  if (version >= 103) bytes += std::string(24, '\0');
  bytes += data;
  if (version == 101) bytes += pack(std::uint32_t{1}, std::uint64_t{3}) + "abc";
  return bytes;
}

std::string frame(int version, const std::vector<std::string>& lists) {
  std::string bytes = version >= 102 ? pack(0.5F) : std::string{};
  bytes += pack(static_cast<std::uint32_t>(lists.size()));
  for (const std::string& one : lists) bytes += one;
  return bytes;
}

std::string file(int version, const std::vector<std::string>& frames) {
  std::string bytes("MMPLD\0", 6);
  bytes += pack(word(version), static_cast<std::uint32_t>(frames.size())) + std::string(48, '\0');
  std::uint64_t at = bytes.size() + 8 * (frames.size() + 1);
  for (const std::string& one : frames) {
    bytes += pack(at);
    at += one.size();
  }
  bytes += pack(at);
  for (const std::string& one : frames) bytes += one;
  return bytes;
}

ParticleSet load_mmpld(const std::string& bytes, ColourKind colour = ColourKind::rgba8,
                       const std::string& suffix = "") {
  const TemporaryFolder folder;
  return load_particles(folder.write("a.mmpld", bytes).string() + suffix, colour);
}

TEST(Mmpld, ReadsEveryVersion) {
  for (const int version : {100, 101, 102, 103}) {
    SCOPED_TRACE(version);
    const std::string one = list(version, 1, 0, pack(0.5F, byte(255), byte(0), byte(51), byte(255)),
                                 2, pack(1.F, 2.F, 3.F, 4.F, 5.F, 6.F));
    const std::string other =
        list(version, 2, 1, "", 1, pack(7.F, 8.F, 9.F, 2.F, byte(1), byte(2), byte(3)));
    const ParticleSet set = load_mmpld(file(version, {frame(version, {one, other})}));
    EXPECT_THAT(set.spheres,
                ElementsAre(Sphere{1, 2, 3, 0.5}, Sphere{4, 5, 6, 0.5}, Sphere{7, 8, 9, 2}));
    EXPECT_THAT(set.rgba8, ElementsAre(0xFF3300FFU, 0xFF3300FFU, 0xFF030201U));
    EXPECT_THAT(set.ids, ElementsAre(0U, 1U, 2U));
    EXPECT_EQ(set.hash.size(), 32U);
  }
}

TEST(Mmpld, ReadsEveryKindOfPosition) {
  const std::string shorts = pack(std::int16_t{-1}, std::int16_t{2}, std::int16_t{300});
  const std::string rgba = pack(byte(1), byte(2), byte(3), byte(4));
  EXPECT_THAT(
      load_mmpld(file(100, {frame(100, {list(100, 3, 0, pack(2.F) + rgba, 1, shorts)})})).spheres,
      ElementsAre(Sphere{-1, 2, 300, 2}));
  EXPECT_THAT(
      load_mmpld(
          file(103, {frame(103, {list(103, 4, 0, pack(2.F) + rgba, 1, pack(0.25, 1e3, -4.0))})}))
          .spheres,
      ElementsAre(Sphere{0.25, 1000, -4, 2}));
}

TEST(Mmpld, ReadsEveryKindOfColour) {
  const std::string place = pack(0.F, 0.F, 0.F);
  const std::string radius = pack(1.F);
  struct Case {
    int type;
    std::string header;
    std::string colour;
    std::array<float, 3> rgb;
  };
  const std::vector<Case> cases{
      {0, pack(byte(51), byte(102), byte(255), byte(0)), "", {0.2F, 0.4F, 1}},
      {1, "", pack(byte(51), byte(102), byte(255)), {0.2F, 0.4F, 1}},
      {2, "", pack(byte(51), byte(102), byte(255), byte(7)), {0.2F, 0.4F, 1}},
      {3, pack(10.F, 20.F), pack(12.5F), {0.25F, 0.25F, 0.25F}},
      {4, "", pack(0.1F, 0.2F, 0.3F), {0.1F, 0.2F, 0.3F}},
      {5, "", pack(0.1F, 7.F, -1.F, 0.F), {0.1F, 1, 0}},
      {6, "", pack(word(65535), word(0), word(13107), word(1)), {1, 0, 0.2F}},
      {7, pack(10.F, 20.F), pack(25.0), {1, 1, 1}},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.type);
    const std::string bytes = file(
        103, {frame(103, {list(103, 1, one.type, radius + one.header, 1, place + one.colour)})});
    const ParticleSet set = load_mmpld(bytes, ColourKind::rgba32);
    ASSERT_EQ(set.count(), 1U);
    EXPECT_THAT(set.rgba32[0], ElementsAre(FloatEq(one.rgb[0]), FloatEq(one.rgb[1]),
                                           FloatEq(one.rgb[2]), FloatEq(1)));
  }
}

TEST(Mmpld, IntensityIsTheFilesOrTheListsRank) {
  const std::string own =
      list(100, 1, 3, pack(1.F, 0.F, 4.F), 2, pack(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 3.F));
  const std::string plain = list(100, 1, 0, pack(1.F, 0), 1, pack(0.F, 0.F, 0.F));
  EXPECT_THAT(load_mmpld(file(100, {frame(100, {own, plain})}), ColourKind::intensity).intensity,
              ElementsAre(0.25F, 0.75F, 0.5F));
  const std::string two = list(100, 1, 0, pack(1.F, 0), 2, std::string(24, '\0'));
  EXPECT_THAT(load_mmpld(file(100, {frame(100, {two})}), ColourKind::intensity).intensity,
              ElementsAre(0.F, 0.5F));
}

TEST(Mmpld, SelectsAFrame) {
  const auto at = [](float x) {
    return frame(102, {list(102, 1, 0, pack(1.F, 0), 1, pack(x, 0.F, 0.F))});
  };
  const std::string bytes = file(102, {at(1), at(2)});
  EXPECT_EQ(load_mmpld(bytes).spheres[0][0], 1);
  EXPECT_EQ(load_mmpld(bytes, ColourKind::rgba8, "@1").spheres[0][0], 2);
  EXPECT_THAT(
      [&] { load_mmpld(bytes, ColourKind::rgba8, "@2"); },
      ThrowsMessage<core::InputError>(HasSubstr("no frame 2; number of frames in the file: 2")));
}

TEST(Mmpld, DropsAndCountsInvalidSpheres) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float inf = std::numeric_limits<float>::infinity();
  const std::string data = pack(1.F, 0.F, 0.F, 1.F, 10.F) + pack(nan, 0.F, 0.F, 1.F, 20.F) +
                           pack(2.F, 0.F, inf, 1.F, 30.F) + pack(3.F, 0.F, 0.F, 0.F, 40.F) +
                           pack(4.F, 0.F, 0.F, -1.F, 50.F) + pack(5.F, 0.F, 0.F, 1.F, 60.F);
  const ParticleSet set = load_mmpld(
      file(100, {frame(100, {list(100, 2, 3, pack(0.F, 100.F), 6, data)})}), ColourKind::intensity);
  EXPECT_EQ(set.dropped, 4U);
  EXPECT_THAT(set.spheres, ElementsAre(Sphere{1, 0, 0, 1}, Sphere{5, 0, 0, 1}));
  EXPECT_THAT(set.ids, ElementsAre(0U, 5U));
  EXPECT_THAT(set.intensity, ElementsAre(0.1F, 0.6F));
}

TEST(Mmpld, RejectsFilesWithoutSpheres) {
  const std::string flat = list(100, 1, 0, pack(0.F, 0), 3, std::string(36, '\0'));
  EXPECT_THAT(
      [&] { load_mmpld(file(100, {frame(100, {flat})})); },
      ThrowsMessage<core::InputError>(AllOf(
          HasSubstr("a.mmpld: none of the 3 particles can be drawn"), HasSubstr("radii above 0"))));
}

TEST(Mmpld, RejectsEveryTruncation) {
  const std::string bytes =
      file(103, {frame(103, {list(103, 1, 3, pack(1.F, 0.F, 1.F), 1, pack(0.F, 0.F, 0.F, 1.F))})});
  EXPECT_EQ(load_mmpld(bytes).count(), 1U);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(load_mmpld(bytes.substr(0, size)), core::InputError) << size;
  }
}

void expect_mmpld_refused(const std::string& bytes, const std::string& expectation) {
  EXPECT_THAT(
      [&] { load_mmpld(bytes); },
      ThrowsMessage<core::InputError>(AllOf(HasSubstr("a.mmpld: byte "), HasSubstr(expectation))));
}

TEST(Mmpld, ReportsWhatWasExpected) {
  const std::string header = pack(1.F, 0);
  const auto with = [&](int vertex, int colour, std::uint64_t count) {
    return file(100,
                {frame(100, {list(100, vertex, colour, header, count, std::string(12, '\0'))})});
  };
  expect_mmpld_refused("MMPLE" + with(1, 0, 1).substr(5), "byte 0: expected 'MMPLD'");
  expect_mmpld_refused(file(104, {frame(104, {})}), "version from 100 to 103, found 104");
  expect_mmpld_refused(with(5, 0, 1), "vertex type from 0 to 4, found 5");
  expect_mmpld_refused(with(1, 8, 1), "colour type from 0 to 7, found 8");
  expect_mmpld_refused(with(1, 0, 2), "expected the list's particles");
  expect_mmpld_refused(with(1, 0, 0), "expected the frame to end");
  expect_mmpld_refused(with(1, 0, 4'294'967'295), "(the limit is 4294967294)");
  expect_mmpld_refused(with(1, 0, ~std::uint64_t{0}), "too many");
  expect_mmpld_refused(file(100, {frame(100, {})}), "expected particles");
  expect_mmpld_refused(file(100, {}), "no frame 0; number of frames in the file: 0");
  std::string table = with(1, 0, 1);
  table.replace(60, 8, pack(std::uint64_t{8}));
  expect_mmpld_refused(table, "frame 0 must lie between byte");
}

}  // namespace
}  // namespace triptych::scene
