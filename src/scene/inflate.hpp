#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace triptych::scene {

// The largest decompressed size of a gzip stream. There is a limit because a few megabytes can
// decompress to a thousand times their size. Users can decompress a larger file themselves, because
// uncompressed files may have any size.
inline constexpr std::uint64_t most_unpacked_bytes = std::uint64_t{1} << 30;

// Throws InputError with the message that the file decompresses to more than `most` bytes.
[[noreturn]] void refuse_unpacked(const std::string& file, std::uint64_t most);

// A function that fills a buffer and returns the number of bytes read, which is smaller than the
// buffer only at the end of the data.
using ByteSource = std::function<std::size_t(std::span<std::byte>)>;

enum class Wrapper : std::uint8_t { gzip, gzip_or_zlib };

// Decompresses a gzip stream (RFC 1952, with one or more members, optionally followed by zero
// bytes) or a zlib stream (RFC 1950) piece by piece into the caller's memory.
class Inflater {
 public:
  // `source` may return fewer bytes than requested before its end, but it returns 0 bytes only at
  // its end. `name` is the file name that errors mention.
  Inflater(ByteSource source, std::string name, Wrapper wrapper = Wrapper::gzip);
  Inflater(Inflater&&) noexcept;
  Inflater& operator=(Inflater&&) noexcept;
  ~Inflater();

  // Fills `out` and returns the number of bytes written, which is less than the size of `out` only
  // if the stream ended properly. Throws InputError for a stream that is damaged, ends prematurely,
  // has a wrong checksum, or is followed by other data.
  std::size_t read(std::span<std::byte> out);

  // Reads and discards `count` bytes, or all remaining bytes if there are fewer.
  void skip(std::uint64_t count);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace triptych::scene
