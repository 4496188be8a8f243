#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace triptych::scene {

// What a gzip stream may hold: a few megabytes can unpack to a thousand times as much. Who means it
// unpacks the file, as plain files may have any size.
inline constexpr std::uint64_t most_unpacked_bytes = std::uint64_t{1} << 30;

// Throws InputError: the file unpacks to more than `most` bytes.
[[noreturn]] void refuse_unpacked(const std::string& file, std::uint64_t most);

// Fills a buffer and returns how many bytes were there, fewer only at the end.
using ByteSource = std::function<std::size_t(std::span<std::byte>)>;

enum class Wrapper : std::uint8_t { gzip, gzip_or_zlib };

// Decompresses a gzip stream (RFC 1952, one member or several, then zero bytes or none) or a zlib
// stream (RFC 1950) piece by piece into the caller's memory.
class Inflater {
 public:
  // `source` may return fewer bytes than asked for before its end, but none only there. `name` is
  // the file named in errors.
  Inflater(ByteSource source, std::string name, Wrapper wrapper = Wrapper::gzip);
  Inflater(Inflater&&) noexcept;
  Inflater& operator=(Inflater&&) noexcept;
  ~Inflater();

  // Fills `out` and returns its size, or less where the stream ended properly. Throws InputError
  // for a stream that is damaged, ends early, fails its check sum or is followed by anything else.
  std::size_t read(std::span<std::byte> out);

  // Reads and drops so many bytes, or all where there are fewer.
  void skip(std::uint64_t count);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace triptych::scene
