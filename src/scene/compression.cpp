#include "scene/compression.hpp"

#include <bzlib.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace triptych::scene {
namespace {

struct Magic {
  std::string_view bytes;
  std::string_view name;
  std::string_view command;  // a command that decompresses such a file
};
constexpr std::array<Magic, 5> foreign{{{"\xFD"
                                         "7zXZ",
                                         "xz", "xz -d"},
                                        {"\x28\xB5\x2F\xFD", "Zstandard", "zstd -d"},
                                        {"PK\x03\x04", "ZIP", "unzip"},
                                        {"7z\xBC\xAF", "7-Zip", "7z x"},
                                        {"\x1F\x9D", "compress", "uncompress"}}};

// Decompresses bzip2 data, with the same interface as Inflater. The data may consist of several
// concatenated streams.
class Bunzipper {
 public:
  Bunzipper(ByteSource source, std::string name)
      : source_(std::move(source)), name_(std::move(name)) {
    open();
  }
  Bunzipper(const Bunzipper&) = delete;
  Bunzipper& operator=(const Bunzipper&) = delete;
  ~Bunzipper() { BZ2_bzDecompressEnd(&stream_); }

  std::size_t read(std::span<std::byte> out) {
    std::size_t filled = 0;
    while (filled < out.size()) {
      if (!has_input()) {
        if (ended_) break;
        reject("the data end prematurely");
      }
      if (ended_) {
        BZ2_bzDecompressEnd(&stream_);
        open();
      }
      const auto piece = static_cast<unsigned>(
          std::min<std::size_t>(out.size() - filled, std::numeric_limits<unsigned>::max()));
      stream_.next_out = reinterpret_cast<char*>(out.data() + filled);
      stream_.avail_out = piece;
      step();
      filled += piece - stream_.avail_out;
    }
    return filled;
  }

 private:
  void open() {
    // The remaining input belongs to the next stream.
    char* const next = stream_.next_in;
    const unsigned left = stream_.avail_in;
    stream_ = {};
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw std::bad_alloc();
    stream_.next_in = next;
    stream_.avail_in = left;
    ended_ = false;
  }

  bool has_input() {
    if (stream_.avail_in == 0) {
      stream_.avail_in = static_cast<unsigned>(source_(buffer_));
      stream_.next_in = reinterpret_cast<char*>(buffer_.data());
    }
    return stream_.avail_in > 0;
  }

  void step() {
    const int code = BZ2_bzDecompress(&stream_);
    if (code == BZ_MEM_ERROR) throw std::bad_alloc();
    if (code == BZ_STREAM_END) {
      ended_ = true;
    } else if (code != BZ_OK) {
      reject(code == BZ_DATA_ERROR_MAGIC ? "the bzip2 header is missing" : "the data are damaged");
    }
  }

  [[noreturn]] void reject(std::string_view reason) const {
    throw core::InputError({.file = name_}, fmt::format("broken bzip2 stream: {}", reason));
  }

  ByteSource source_;
  std::string name_;
  std::vector<std::byte> buffer_ = std::vector<std::byte>(std::size_t{1} << 16U);
  bz_stream stream_{};
  bool ended_ = false;
};

}  // namespace

std::string_view name_of(Packing packing) {
  return packing == Packing::gzip ? "gzip" : packing == Packing::bzip2 ? "bzip2" : "none";
}

Packing packing_of(std::span<const std::byte> start, const std::string& file) {
  const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
  if (text.starts_with("\x1F\x8B")) return Packing::gzip;
  if (text.starts_with("BZh") && text.size() > 3 && text[3] >= '1' && text[3] <= '9') {
    return Packing::bzip2;
  }
  for (const Magic& magic : foreign) {
    if (!text.starts_with(magic.bytes)) continue;
    throw core::InputError({.file = file},
                           fmt::format("the file is compressed with {}; unpack it first: {} {}",
                                       magic.name, magic.command, file));
  }
  return Packing::none;
}

ByteSource unpacked(ByteSource source, Packing packing, const std::string& file) {
  if (packing == Packing::gzip) {
    const auto inflater = std::make_shared<Inflater>(std::move(source), file);
    return [inflater](std::span<std::byte> out) { return inflater->read(out); };
  }
  if (packing == Packing::bzip2) {
    const auto bunzipper = std::make_shared<Bunzipper>(std::move(source), file);
    return [bunzipper](std::span<std::byte> out) { return bunzipper->read(out); };
  }
  return source;
}

ByteSource file_bytes(const std::filesystem::path& file, std::uint64_t start) {
  const auto in = std::make_shared<std::ifstream>(file, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  const std::string name = file.string();
  if (!*in || error) throw core::IoError(name + ": the file cannot be read");
  in->seekg(static_cast<std::streamoff>(std::min<std::uintmax_t>(start, size)));
  return [in, name](std::span<std::byte> out) {
    in->read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
    if (in->bad()) throw core::IoError(name + ": reading failed");
    return static_cast<std::size_t>(in->gcount());
  };
}

Packing packing_of_file(const std::filesystem::path& file) {
  std::array<std::byte, 8> start{};
  const std::size_t got = file_bytes(file)(start);
  return packing_of(std::span(start).first(got), file.string());
}

ByteSource content_bytes(const std::filesystem::path& file) {
  return unpacked(file_bytes(file), packing_of_file(file), file.string());
}

std::string content_start(const std::filesystem::path& file, std::size_t most) {
  const ByteSource source = content_bytes(file);
  std::string text;
  constexpr std::size_t piece = std::size_t{1} << 16U;
  while (text.size() < most) {
    const std::size_t before = text.size();
    text.resize(std::min(before + piece, most));
    const auto out = std::as_writable_bytes(std::span(text)).subspan(before);
    const std::size_t got = source(out);
    text.resize(before + got);
    if (got < out.size()) break;
  }
  return text;
}

std::uint64_t skip_bytes(const ByteSource& source, std::uint64_t count) {
  std::array<std::byte, 4096> dropped{};
  std::uint64_t done = 0;
  while (done < count) {
    const auto piece =
        static_cast<std::size_t>(std::min<std::uint64_t>(count - done, dropped.size()));
    const std::size_t got = source(std::span(dropped).first(piece));
    done += got;
    if (got < piece) break;
  }
  return done;
}

}  // namespace triptych::scene
