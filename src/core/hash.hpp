#pragma once
// Content hashes: to tell whether two things are the same, not to protect them. They are the same
// on every machine, compiler and version of a library, for they are taken over bytes. Text made
// from numbers is not: how it looks is a formatting library's taste.

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace triptych::core {

// XXH3, 128 bits, as 32 lower-case hexadecimal digits.
[[nodiscard]] std::string content_hash(std::span<const std::byte> bytes);
[[nodiscard]] std::string content_hash(std::string_view text);

// The content hash of what is made of several parts, in the order in which they are added:
//   a number    eight bytes, the lowest first: an integer in two's complement, a floating point
//   number as a double's bits
//               (so that 0 and −0 are two, and an int, a long and a float have the bytes of the
//               widest)
//   text        its length as a number, then its bytes
//   an array    the content hash of its elements' bytes as they lie in memory, as text
// Which parts there are, and how many, is the kind's own: a list of unknown length has its length
// in front.
class HashBuilder {
 public:
  // The name of what it identifies, which is its first part.
  explicit HashBuilder(std::string_view kind) { add(kind); }

  template <std::integral T>
  HashBuilder& add(T number) {
    return add_word(static_cast<std::uint64_t>(number));
  }
  HashBuilder& add(double number) { return add_word(std::bit_cast<std::uint64_t>(number)); }
  HashBuilder& add(std::string_view text);
  HashBuilder& add(const char* text) { return add(std::string_view(text)); }

  // The elements have no padding.
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
