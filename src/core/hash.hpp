#pragma once
// Content hashes decide whether two things are equal. They do not protect against manipulation.
// They are the same on every machine, compiler and library version, because they are computed from
// bytes. Formatted numbers are never hashed, because their format depends on a library.

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace triptych::core {

// XXH3 with 128 bits, as 32 lower-case hexadecimal digits.
[[nodiscard]] std::string content_hash(std::span<const std::byte> bytes);
[[nodiscard]] std::string content_hash(std::string_view text);

// The content hash of something that consists of several parts, in the order in which they are
// added:
//   a number    eight bytes, lowest first: an integer in two's complement, a floating-point number
//               as the bits of a double. So 0 and −0 differ, and an int, a long and a float are
//               hashed like the widest type.
//   text        its length as a number, then its bytes
//   an array    as text, the content hash of its elements' bytes in memory
// The kind determines which parts there are and how many. A list of variable length is preceded by
// its length.
class HashBuilder {
 public:
  // The first part of the hash is the name of the kind of object, such as a table or a set of
  // particles.
  explicit HashBuilder(std::string_view kind) { add(kind); }

  template <std::integral T>
  HashBuilder& add(T number) {
    return add_word(static_cast<std::uint64_t>(number));
  }
  HashBuilder& add(double number) { return add_word(std::bit_cast<std::uint64_t>(number)); }
  HashBuilder& add(std::string_view text);
  HashBuilder& add(const char* text) { return add(std::string_view(text)); }

  // The elements must have no padding.
  template <typename T, std::size_t N>
  HashBuilder& add_array(std::span<T, N> elements) {
    static_assert(std::endian::native == std::endian::little, "the lowest byte is the first");
    return add(content_hash(std::as_bytes(elements)));
  }

  [[nodiscard]] std::string hash() const { return content_hash(bytes_); }

 private:
  HashBuilder& add_word(std::uint64_t word);

  std::string bytes_;
};

}  // namespace triptych::core
