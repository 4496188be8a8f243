#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image_io.hpp"

namespace triptych::core {
namespace {

constexpr std::array<const char*, 4> colour_channels{"R", "G", "B", "A"};
constexpr const char* depth_channel = "Z";
constexpr const char* id_channel = "id";
constexpr int largest_side = 1 << 16;  // pixels along either axis

class MemoryOut : public Imf::OStream {
 public:
  MemoryOut() : Imf::OStream("memory") {}
  void write(const char data[], int count) override {
    const auto n = static_cast<std::size_t>(count);
    if (bytes_.size() < place_ + n) bytes_.resize(place_ + n);
    std::memcpy(bytes_.data() + place_, data, n);
    place_ += n;
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t place) override { place_ = place; }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
  std::size_t place_ = 0;
};

class MemoryIn : public Imf::IStream {
 public:
  explicit MemoryIn(std::span<const std::byte> bytes) : Imf::IStream("memory"), bytes_(bytes) {}
  bool read(char data[], int count) override {
    const auto n = static_cast<std::size_t>(count);
    if (count < 0 || place_ > bytes_.size() || n > bytes_.size() - place_) {
      throw std::runtime_error(
          fmt::format("the file is truncated; it ends after {} bytes", bytes_.size()));
    }
    std::memcpy(data, bytes_.data() + place_, n);
    place_ += n;
    return place_ < bytes_.size();
  }
  std::uint64_t tellg() override { return place_; }
  void seekg(std::uint64_t place) override { place_ = place; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t place_ = 0;
};

// Describes the memory layout of an image to OpenEXR. The first pixel of the image has the OpenEXR
// coordinates (x, y), the corner of the data window. However, OpenEXR expects the address that the
// pixel with the coordinates (0, 0) would have, even if there is no such pixel. slice() computes
// this address.
class Planes {
 public:
  Planes(const Image& image, int x, int y)
      : width_(static_cast<std::size_t>(image.width)),
        corner_(static_cast<std::ptrdiff_t>(y) * image.width + x) {}

  // OpenEXR requires a non-const pointer even if it only reads from the memory.
  [[nodiscard]] Imf::Slice slice(Imf::PixelType type, const void* first, std::size_t step) const {
    const auto base = reinterpret_cast<std::uintptr_t>(first) -
                      static_cast<std::uintptr_t>(corner_) * static_cast<std::uintptr_t>(step);
    return {type, reinterpret_cast<char*>(base), step, step * width_};
  }

 private:
  std::size_t width_;
  std::ptrdiff_t corner_;
};

Imf::FrameBuffer frame_of(const Image& image, int x, int y) {
  const Planes planes(image, x, y);
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < colour_channels.size(); ++c) {
    frame.insert(colour_channels.at(c),
                 planes.slice(Imf::FLOAT, image.rgba.data() + c, 4 * sizeof(float)));
  }
  if (!image.depth.empty()) {
    frame.insert(depth_channel, planes.slice(Imf::FLOAT, image.depth.data(), sizeof(float)));
  }
  if (!image.ids.empty()) {
    frame.insert(id_channel, planes.slice(Imf::UINT, image.ids.data(), sizeof(std::uint32_t)));
  }
  return frame;
}

void require_consistent(const Image& image) {
  const std::size_t n = image.pixel_count();
  const bool plausible = image.width > 0 && image.height > 0 && image.rgba.size() == 4 * n &&
                         (image.depth.empty() || image.depth.size() == n) &&
                         (image.ids.empty() || image.ids.size() == n);
  if (!plausible) {
    throw InputError(fmt::format(
        "cannot write an EXR image of {}x{} pixels: the array sizes do not match ({} colour "
        "values, {} depths, {} ids)",
        image.width, image.height, image.rgba.size(), image.depth.size(), image.ids.size()));
  }
}

void require_channels(const Imf::ChannelList& channels) {
  for (const char* name : colour_channels) {
    if (channels.findChannel(name) == nullptr) {
      throw std::runtime_error(fmt::format("channel {} is missing; expected R, G, B and A", name));
    }
  }
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
      throw std::runtime_error(
          fmt::format("channel {} is subsampled, which is not supported", channel.name()));
    }
  }
  const Imf::Channel* ids = channels.findChannel(id_channel);
  if (ids != nullptr && ids->type != Imf::UINT) {
    throw std::runtime_error("channel id must have the type uint");
  }
}

// Creates an image of the size that the header states. A broken header may state any size.
// Therefore a size is rejected before memory is allocated if even the best compression could not
// fit so many pixels into the file.
Image allocate(const Imf::Header& header, std::size_t file_bytes) {
  constexpr std::size_t most_pixels_per_byte = 4096;
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  const bool possible =
      width > 0 && height > 0 && width <= largest_side && height <= largest_side &&
      static_cast<std::size_t>(width * height) / most_pixels_per_byte <= file_bytes;
  if (!possible) {
    throw std::runtime_error(
        fmt::format("invalid image size in the header: {}x{} pixels in a file of {} bytes", width,
                    height, file_bytes));
  }
  Image image(static_cast<int>(width), static_cast<int>(height));
  if (header.channels().findChannel(depth_channel) != nullptr) {
    image.depth.resize(image.pixel_count());
  }
  if (header.channels().findChannel(id_channel) != nullptr) image.ids.resize(image.pixel_count());
  return image;
}

// Throws if the size of an attribute exceeds the file, because OpenEXR allocates memory of that
// size before it checks the length of the file. Also throws if the stated size of the channel list
// is wrong. OpenEXR ignores that size, and reads channels until it finds an empty name.
//
// The file begins with the magic number and the version (8 bytes), followed by a list of
// attributes. Each attribute consists of its name and its type, both terminated by a zero byte, its
// size in 32 bits, and its value. An empty name ends the list. In a channel list, each channel
// consists of a name and 16 bytes.
void require_attributes_inside(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::size_t place = 8;
  const auto take_text = [&] {
    const std::size_t end = std::min(text.find('\0', place), text.size());
    const std::string_view taken = text.substr(place, end - place);
    place = std::min(end + 1, text.size());
    return taken;
  };
  while (place < text.size() && !take_text().empty()) {
    const bool channels = take_text() == "chlist";
    std::int32_t size = 0;
    if (text.size() - place < sizeof(size)) return;  // truncated, which OpenEXR itself reports
    std::memcpy(&size, text.data() + place, sizeof(size));
    place += sizeof(size);
    if (size < 0 || static_cast<std::size_t>(size) > text.size() - place) {
      throw std::runtime_error(
          fmt::format("an attribute of {} bytes at byte {} extends beyond the end of the file ({} "
                      "bytes)",
                      size, place, text.size()));
    }
    const std::size_t end = place + static_cast<std::size_t>(size);
    while (channels && place < text.size() && !take_text().empty()) {
      place = std::min(place + 16, text.size());
    }
    if (channels && place != end) {
      throw std::runtime_error(fmt::format(
          "the channel list ends at byte {}; according to the header, it should end at byte {}",
          place, end));
    }
    place = end;
  }
}

// Makes OpenEXR reject images with a side longer than `largest_side`. This is necessary because
// OpenEXR allocates memory for some rows before the caller can query the size of the image.
void limit_size() {
  static const bool limited = [] {
    Imf::Header::setMaxImageSize(largest_side, largest_side);
    return true;
  }();
  static_cast<void>(limited);
}

Image decode(std::span<const std::byte> bytes) {
  limit_size();
  require_attributes_inside(bytes);
  MemoryIn stream(bytes);
  Imf::InputFile file(stream, 0);
  if (!file.isComplete()) throw std::runtime_error("the file is incomplete");
  require_channels(file.header().channels());
  Image image = allocate(file.header(), bytes.size());
  const Imath::Box2i window = file.header().dataWindow();
  file.setFrameBuffer(frame_of(image, window.min.x, window.min.y));
  file.readPixels(window.min.y, window.max.y);
  return image;
}

// Like decode(bytes), but converts exceptions to an InputError for `place`. Joins the lines of
// their messages, because what() of this project's errors must be a single line.
Image decode(std::span<const std::byte> bytes, const FilePlace& place) {
  try {
    return decode(bytes);
  } catch (const std::exception& error) {
    std::string reason = error.what();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw InputError(place, fmt::format("cannot be read as an EXR image: {}", reason));
  }
}

}  // namespace

std::vector<std::byte> encode_exr(const Image& image, ExrCompression compression) {
  require_consistent(image);
  Imf::Header header(image.width, image.height);
  header.compression() =
      compression == ExrCompression::zip ? Imf::ZIP_COMPRESSION : Imf::RLE_COMPRESSION;
  for (const char* name : colour_channels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  if (!image.depth.empty()) header.channels().insert(depth_channel, Imf::Channel(Imf::FLOAT));
  if (!image.ids.empty()) header.channels().insert(id_channel, Imf::Channel(Imf::UINT));
  MemoryOut stream;
  {
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(frame_of(image, 0, 0));
    file.writePixels(image.height);
  }  // the destructor writes the table of line offsets
  return stream.take();
}

void write_exr(const Image& image, const std::filesystem::path& file) {
  write_file(encode_exr(image), file);
}

Image read_exr(const std::filesystem::path& file) {
  return decode(read_file(file), FilePlace{.file = file.string()});
}

Image decode_exr(std::span<const std::byte> bytes, const std::string& name) {
  return decode(bytes, FilePlace{.file = name});
}

}  // namespace triptych::core
