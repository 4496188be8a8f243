#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image_io.hpp"
#include "core/random.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::core {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

// Returns an image with random bits, so that its values include NaN payloads, infinities and
// denormals.
Image noise(int width, int height, bool particles) {
  Random random(7);
  Image image(width, height);
  const auto any = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(random.bits())); };
  for (float& value : image.rgba) value = any();
  if (particles) {
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
      image.depth.push_back(any());
      image.ids.push_back(static_cast<std::uint32_t>(random.bits()));
    }
    image.depth[0] = std::numeric_limits<float>::infinity();
    image.ids[0] = Image::no_particle;
  }
  return image;
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expect_same(const Image& a, const Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_TRUE(same_bits(a.rgba, b.rgba));
  EXPECT_TRUE(same_bits(a.depth, b.depth));
  EXPECT_TRUE(same_bits(a.ids, b.ids));
}

TEST(Exr, KeepsEveryBit) {
  for (const bool particles : {false, true}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {17, 13}, {1, 40}, {64, 33}}) {
      const Image image = noise(width, height, particles);
      for (const auto compression : {ExrCompression::run_lengths, ExrCompression::zip}) {
        expect_same(decode_exr(encode_exr(image, compression)), image);
      }
    }
  }
}

TEST(Exr, FileAndMemoryAgree) {
  const TemporaryFolder folder;
  const Image image = noise(9, 5, true);
  write_exr(image, folder.path() / "a.exr");
  EXPECT_EQ(read_file(folder.path() / "a.exr"), encode_exr(image));
  expect_same(read_exr(folder.path() / "a.exr"), image);
}

// Reads the file with OpenEXR's own reader, as other programs do.
TEST(Exr, CanBeReadByOtherPrograms) {
  const TemporaryFolder folder;
  Image image(3, 2);
  image.rgba[4 * 2 + 1] = 0.25F;  // green in the top right corner
  image.depth.assign(6, 1.5F);
  image.ids.assign(6, 4);
  write_exr(image, folder.path() / "a.exr");
  const Imf::InputFile file((folder.path() / "a.exr").c_str());
  EXPECT_EQ(file.header().compression(), Imf::RLE_COMPRESSION);
  EXPECT_EQ(file.header().channels()["R"].type, Imf::FLOAT);
  EXPECT_EQ(file.header().channels()["Z"].type, Imf::FLOAT);
  EXPECT_EQ(file.header().channels()["id"].type, Imf::UINT);
  Imf::RgbaInputFile rgba((folder.path() / "a.exr").c_str());
  std::array<Imf::Rgba, 6> pixels;
  rgba.setFrameBuffer(pixels.data(), 1, 3);
  rgba.readPixels(0, 1);
  EXPECT_EQ(static_cast<float>(pixels[2].g), 0.25F);
}

TEST(Exr, ReadsHalfFloatsAndShiftedWindows) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "half.exr";
  // The frame has 5 columns and 7 rows, but only its lower right 3×2 pixels are written to the
  // file.
  std::vector<Imf::Rgba> frame(5 * 7);
  frame[5 * 5 + 3] = Imf::Rgba(0, 1, 0, 1);
  frame[5 * 6 + 4] = Imf::Rgba(0, 0, 0.5F, 0.5F);
  {
    const Imath::Box2i window({2, 5}, {4, 6});
    Imf::RgbaOutputFile out(file.c_str(), window, window, Imf::WRITE_RGBA);
    out.setFrameBuffer(frame.data(), 1, 5);
    out.writePixels(2);
  }
  const Image image = read_exr(file);
  ASSERT_EQ(image.width, 3);
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(image.pixel(1, 0), (std::array<float, 4>{0, 1, 0, 1}));
  EXPECT_EQ(image.pixel(2, 1), (std::array<float, 4>{0, 0, 0.5F, 0.5F}));
}

TEST(Exr, ReportsTheMissingChannel) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "rgb.exr";
  {
    const Imf::Rgba pixel(1, 0, 0, 1);
    Imf::RgbaOutputFile out(file.c_str(), 1, 1, Imf::WRITE_RGB);
    out.setFrameBuffer(&pixel, 1, 1);
    out.writePixels(1);
  }
  EXPECT_THAT(
      [&] { (void)read_exr(file); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("rgb.exr: "), HasSubstr("channel A is missing"))));
}

TEST(Exr, EveryTruncationIsReportedInOneLine) {
  const std::vector<std::byte> bytes = encode_exr(noise(19, 40, true));
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 50) {
    EXPECT_THAT([&] { (void)decode_exr(std::span(bytes).first(length)); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("EXR"), Not(HasSubstr("\n")))))
        << length << " of " << bytes.size() << " bytes";
  }
}

// Whichever byte is damaged, the result must be an image or a typed error, but never a crash or an
// infinite loop.
TEST(Exr, DamagedBytesLeadToAnImageOrATypedError) {
  const std::vector<std::byte> bytes = encode_exr(noise(8, 20, false));
  for (std::size_t i = 0; i < std::min<std::size_t>(bytes.size(), 600); ++i) {
    std::vector<std::byte> damaged = bytes;
    damaged[i] ^= std::byte{0xFF};
    try {
      (void)decode_exr(damaged);
    } catch (const InputError&) {
    }
  }
}

// Given this header of a few hundred bytes, OpenEXR would allocate two gigabytes.
TEST(Exr, AnAttributeBeyondTheFileIsRejectedBeforeAllocating) {
  std::vector<std::byte> bytes = encode_exr(noise(8, 20, false));
  const std::string_view name("channels\0chlist", 15);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  const std::size_t size = std::string_view(text, bytes.size()).find(name) + name.size() + 1;
  bytes[size + 3] = std::byte{0x7F};
  EXPECT_THAT([&] { (void)decode_exr(bytes, "large.exr"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("large.exr: "), HasSubstr("attribute of"),
                                              HasSubstr(fmt::format("at byte {}", size + 4)))));
}

TEST(Exr, ChannelsWithAWrongEndAreRejected) {
  std::vector<std::byte> bytes = encode_exr(noise(8, 20, false));
  const std::string_view first("A\0\2\0\0\0", 6);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  bytes[std::string_view(text, bytes.size()).find(first) + 1] = std::byte{0x94};
  EXPECT_THAT([&] { (void)decode_exr(bytes, "channels.exr"); },
              ThrowsMessage<InputError>(HasSubstr("channel list ends at byte")));
}

// Returns an image file whose header gives these coordinates for the last pixel. ZIP compresses 16
// rows at a time. If each row were compressed alone, as with run lengths, OpenEXR would notice
// first that the table of rows is too long for the file.
std::vector<std::byte> with_last_pixel(std::int32_t x, std::int32_t y) {
  std::vector<std::byte> bytes = encode_exr(noise(8, 20, false), ExrCompression::zip);
  const std::string_view name("dataWindow\0box2i", 16);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  const std::size_t value =
      std::string_view(text, bytes.size()).find(name) + name.size() + 1 + sizeof(std::int32_t);
  const std::array last{x, y};
  std::memcpy(bytes.data() + value + 2 * sizeof(std::int32_t), last.data(), sizeof(last));
  return bytes;
}

// For eight million columns, OpenEXR would allocate half a gigabyte for the first rows.
TEST(Exr, AWindowThatIsTooWideIsRejectedBeforeAllocating) {
  EXPECT_THAT([&] { (void)decode_exr(with_last_pixel(0x7A004D, 19), "wide.exr"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("wide.exr: "), HasSubstr("65536"))));
}

// The image would need 400 megabytes, but the file has only a few thousand bytes.
TEST(Exr, AWindowThatIsTooLargeForItsFileIsRejectedBeforeAllocating) {
  EXPECT_THAT([&] { (void)decode_exr(with_last_pixel(4999, 4999), "large.exr"); },
              ThrowsMessage<InputError>(HasSubstr(
                  "large.exr: cannot be read as an EXR image: invalid image size in the header: "
                  "5000x5000 pixels in a file of ")));
}

TEST(Exr, DistinguishesMissingFromBrokenFiles) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)read_exr(folder.path() / "none.exr"), IoError);
  const auto text = folder.write("text.exr", "this is no image");
  EXPECT_THAT([&] { (void)read_exr(text); },
              ThrowsMessage<InputError>(HasSubstr("text.exr: cannot be read as an EXR image")));
}

TEST(Exr, RejectsInconsistentImages) {
  EXPECT_THROW((void)encode_exr(Image{}), InputError);
  Image image(2, 2);
  image.depth.assign(3, 0);
  EXPECT_THROW((void)encode_exr(image), InputError);
}

TEST(Exr, FailedWriteIsAnIoErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_exr(Image(2, 2), folder.path() / "no" / "a.exr"), IoError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace triptych::core
