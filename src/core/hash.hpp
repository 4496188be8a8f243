#pragma once
// Content hashes, which are compared to find out whether two objects are equal. They do not protect
// against manipulation. They are computed from bytes, so they are the same on every machine and
// with every compiler and library version. Numbers are never formatted before they are hashed,
// because the format can depend on the library.

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace triptych::core {

// Returns the 128-bit XXH3 hash of the bytes as 32 lower-case hexadecimal digits.
[[nodiscard]] std::string content_hash(std::span<const std::byte> bytes);
[[nodiscard]] std::string content_hash(std::string_view text);

// Computes the content hash of an object that consists of several parts. They are hashed in the
// order in which they are added, in this form:
//   a number    eight bytes, lowest first: an integer in two's complement, a floating-point number
//               as the bits of a double. So 0 and −0 differ, and an int, a long and a float are
//               hashed like the widest type.
//   text        its length as a number, then its bytes
//   an array    as text, the content hash of its elements' bytes in memory
// All objects of one kind have the same sequence of parts. A list of variable length is preceded by
// its length.
class HashBuilder {
 public:
  // `kind` names the kind of object, such as a table or a set of particles. It is the first part
  // that is hashed.
  explicit HashBuilder(std::string_view kind) { add(kind); }

  template <std::integral T>
  HashBuilder& add(T number) {
    return add_word(static_cast<std::uint64_t>(number));
  }
  HashBuilder& add(double number) { return add_word(std::bit_cast<std::uint64_t>(number)); }
  HashBuilder& add(std::string_view text);
  HashBuilder& add(const char* text) { return add(std::string_view(text)); }

  // The elements must not contain padding bytes.
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
