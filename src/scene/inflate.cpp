#include "scene/inflate.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace triptych::scene {

void refuse_unpacked(const std::string& file, std::uint64_t most) {
  throw core::InputError(
      {.file = file},
      fmt::format("the file decompresses to more than {} bytes; if this is intended, decompress it "
                  "first (uncompressed files have no size limit)",
                  most));
}

struct Inflater::Stream {
  Stream(ByteSource source_, std::string name_, Wrapper wrapper)
      : source(std::move(source_)), name(std::move(name_)) {
    const int accepted = (wrapper == Wrapper::gzip ? 16 : 32) + MAX_WBITS;
    if (inflateInit2(&zlib, accepted) != Z_OK) throw std::bad_alloc();
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() { inflateEnd(&zlib); }

  [[noreturn]] void reject(const std::string& reason) const {
    throw core::InputError({.file = name}, "broken gzip stream: " + reason);
  }

  // Returns whether there is compressed input. Reads more input if all of it has been used.
  bool has_input() {
    if (zlib.avail_in == 0) {
      zlib.avail_in = static_cast<uInt>(source(buffer));
      zlib.next_in = reinterpret_cast<Bytef*>(buffer.data());
    }
    return zlib.avail_in > 0;
  }

  // Skips zero bytes after a member (one of the gzip streams that a file may concatenate). Tapes
  // and block devices add zero bytes as padding. No member begins with a zero byte.
  void drop_padding() {
    bool padded = false;
    for (; has_input() && *zlib.next_in == 0; ++zlib.next_in, --zlib.avail_in) padded = true;
    if (padded && has_input()) reject("unexpected data after the zero padding");
  }

  void step() {
    if (ended) {  // another member follows
      inflateReset(&zlib);
      ended = false;
    }
    const int code = inflate(&zlib, Z_NO_FLUSH);
    if (code == Z_MEM_ERROR) throw std::bad_alloc();
    if (code != Z_OK && code != Z_STREAM_END) {
      reject(zlib.msg != nullptr ? zlib.msg : fmt::format("zlib error {}", code));
    }
    ended = code == Z_STREAM_END;
  }

  ByteSource source;
  std::string name;
  std::vector<std::byte> buffer = std::vector<std::byte>(std::size_t{1} << 16);
  z_stream zlib{};
  bool ended = false;
};

Inflater::Inflater(ByteSource source, std::string name, Wrapper wrapper)
    : stream_(std::make_unique<Stream>(std::move(source), std::move(name), wrapper)) {}
Inflater::Inflater(Inflater&&) noexcept = default;
Inflater& Inflater::operator=(Inflater&&) noexcept = default;
Inflater::~Inflater() = default;

std::size_t Inflater::read(std::span<std::byte> out) {
  std::size_t filled = 0;
  while (filled < out.size()) {
    if (stream_->ended) stream_->drop_padding();
    if (!stream_->has_input()) {
      if (stream_->ended) break;
      stream_->reject("the data end prematurely");
    }
    const auto piece = static_cast<uInt>(
        std::min<std::size_t>(out.size() - filled, std::numeric_limits<uInt>::max()));
    stream_->zlib.next_out = reinterpret_cast<Bytef*>(out.data() + filled);
    stream_->zlib.avail_out = piece;
    stream_->step();
    filled += piece - stream_->zlib.avail_out;
  }
  return filled;
}

void Inflater::skip(std::uint64_t count) {
  std::array<std::byte, 4096> dropped{};
  while (count > 0) {
    const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(count, dropped.size()));
    if (read(std::span(dropped).first(piece)) < piece) return;
    count -= piece;
  }
}

}  // namespace triptych::scene
