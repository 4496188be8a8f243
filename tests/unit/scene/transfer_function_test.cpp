#include "scene/transfer_function.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::scene {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string repeated(const std::string& line, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += line;
  return text;
}

TEST(TransferFunction, PresetsAreStraightColoursInRange) {
  EXPECT_EQ(transfer_function_presets(), (std::vector<std::string_view>{"haze", "surfaces"}));
  for (const auto name : transfer_function_presets()) {
    const TransferFunction tf = load_transfer_function(name);
    EXPECT_EQ(tf.name, name);
    for (const auto& entry : tf.entries) {
      for (const float channel : entry) {
        EXPECT_GE(channel, 0);
        EXPECT_LE(channel, 1);
      }
    }
  }
}

// Empty-space skipping needs low values with an opacity of exactly zero, not just nearly zero.
TEST(TransferFunction, LowValuesAreExactlyTransparent) {
  const TransferFunction haze = load_transfer_function("haze");
  for (std::size_t k = 0; k < 32; ++k) EXPECT_EQ(haze.entries.at(k)[3], 0) << k;
  EXPECT_GT(haze.entries.at(34)[3], 0);
  const TransferFunction surfaces = load_transfer_function("surfaces");
  for (std::size_t k = 0; k < 64; ++k) EXPECT_EQ(surfaces.entries.at(k)[3], 0) << k;
}

TEST(TransferFunction, HazeStaysThinAndSurfacesGetOpaqueContinuously) {
  const auto facts = [](std::string_view name) {
    const TransferFunction tf = load_transfer_function(name);
    float largest = 0;
    float jump = 0;
    for (std::size_t k = 0; k < 256; ++k) {
      largest = std::max(largest, tf.entries.at(k)[3]);
      if (k > 0) jump = std::max(jump, std::abs(tf.entries.at(k)[3] - tf.entries.at(k - 1)[3]));
    }
    return std::pair{largest, jump};
  };
  EXPECT_LT(facts("haze").first, 0.07F);
  EXPECT_LT(facts("haze").second, 0.001F);
  EXPECT_GT(facts("surfaces").first, 0.95F);
  EXPECT_LT(facts("surfaces").second, 0.06F);
}

TEST(TransferFunction, ReadsTextOfBytes) {
  const TemporaryFolder folder;
  folder.write("a.tf", "# comment\n\n255 0 51 102\n" + repeated("0 0 0 0\r\n", 255));
  const TransferFunction tf = load_transfer_function("a.tf", {folder.path()});
  EXPECT_EQ(tf.name, "a.tf");
  EXPECT_EQ(tf.entries[0], (std::array<float, 4>{1, 0, 0.2F, 0.4F}));
  EXPECT_EQ(tf.entries[255], (std::array<float, 4>{0, 0, 0, 0}));
}

TEST(TransferFunction, ReadsTextOfFractions) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.tf", repeated("1 0.5 2.5e-1 0\n", 255) + "0 0 0 1");
  const TransferFunction tf = load_transfer_function(file.string());
  EXPECT_EQ(tf.entries[0], (std::array<float, 4>{1, 0.5F, 0.25F, 0}));
  EXPECT_EQ(tf.entries[255], (std::array<float, 4>{0, 0, 0, 1}));
}

TEST(TransferFunction, ReadsRawBytes) {
  const TemporaryFolder folder;
  std::string bytes(1024, '\0');
  bytes[4 * 9 + 2] = static_cast<char>(255);
  bytes[4 * 9 + 3] = 51;
  const auto file = folder.write("a.rgba", bytes);
  const TransferFunction tf = load_transfer_function(file.string());
  EXPECT_EQ(tf.entries[9], (std::array<float, 4>{0, 0, 1, 0.2F}));
  EXPECT_EQ(tf.entries[8], (std::array<float, 4>{0, 0, 0, 0}));
}

// If no value exceeds 1, the values are fractions, even if all of them are whole numbers.
TEST(TransferFunction, WholeNumbersUpToOneAreFractions) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.tf", repeated("0 0 0 1\n", 256));
  EXPECT_EQ(load_transfer_function(file.string()).entries[9][3], 1);
  const auto bytes = folder.write("b.tf", repeated("0 0 0 1\n", 255) + "0 0 2 1\n");
  EXPECT_EQ(load_transfer_function(bytes.string()).entries[9][3], 1 / 255.F);
}

TEST(TransferFunction, IsTransparentBelowItsFirstVisibleEntry) {
  TransferFunction function;
  function.entries[128][3] = 0.5F;
  // The opacity rises from the centre of entry 127, at 127.5/256.
  EXPECT_TRUE(is_transparent(function, 0, 127.5 / 256));
  EXPECT_FALSE(is_transparent(function, 0, 127.6 / 256));
  EXPECT_FALSE(is_transparent(function, 0.1, 0.9));
  EXPECT_FALSE(is_transparent(function, 129.4 / 256, 1));
  EXPECT_TRUE(is_transparent(function, 129.5 / 256, 1));
  function.entries[0][3] = 1;
  EXPECT_FALSE(is_transparent(function, 0, 0));
}

TEST(TransferFunction, BrokenFilesAreReportedWithTheirLine) {
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& text, const std::string& message) {
    const auto file = folder.write("b.tf", text);
    EXPECT_THAT([&] { (void)load_transfer_function(file.string()); },
                ThrowsMessage<core::InputError>(HasSubstr(file.string() + message)));
  };
  expect("0 0 0 0\n0 0 0\n", ":2: expected four values (R G B A), got 3");
  expect("0 0 0 0\n\n0 0 zero 0\n", ":3: 'zero' is not a channel value");
  expect("0 0 0 256\n", ":1: '256' is not a channel value; expected a number from 0 to 255");
  expect("0 0 0 -1\n", ":1: '-1'");
  expect("0 0 nan 1\n", ":1: 'nan'");
  expect("# r g b a\n0,0,0,1\n", ":2: expected four values (R G B A) separated by blanks");
  expect(repeated("0 0 0 0\n", 255), ":255: the file ends after 255 entries; expected 256");
  expect(repeated("0 0 0 0\n", 257), ":257: the file has more than 256 entries");
  expect("", ": the file ends after 0 entries; expected 256");
}

// The cut-off text has exactly the size of a binary table.
TEST(TransferFunction, TruncatedTextIsNotReadAsBytes) {
  const TemporaryFolder folder;
  for (const std::string start : {"", "# made by hand: µ\n"}) {
    const std::string text = (start + repeated("12 0.5 1e1 0\r\n", 256)).substr(0, 1024);
    const auto file = folder.write("c.tf", text);
    EXPECT_THAT([&] { (void)load_transfer_function(file.string()); },
                ThrowsMessage<core::InputError>(HasSubstr(file.string() + ":")))
        << start;
  }
  // A single byte that cannot occur in text makes the file a binary table.
  std::string bytes = repeated("0 0\n", 256);
  bytes[600] = '\1';
  EXPECT_EQ(load_transfer_function(folder.write("c.rgba", bytes).string()).entries[0][0],
            48 / 255.0F);
  EXPECT_EQ(load_transfer_function(folder.write("d.rgba", std::string(1024, '0')).string())
                .entries[255][3],
            48 / 255.0F);
}

TEST(TransferFunction, UnknownNamesAreBadInput) {
  EXPECT_THAT([] { (void)load_transfer_function("hase"); },
              ThrowsMessage<core::InputError>(AllOf(HasSubstr("'hase'"), HasSubstr("surfaces"))));
}

}  // namespace
}  // namespace triptych::scene
