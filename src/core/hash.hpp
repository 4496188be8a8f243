#pragma once
// Content hashes, for finding out whether two objects are equal. They do not protect against
// manipulation. Because they are computed from bytes, they are the same on every machine and with
// every compiler and library version. Numbers are hashed in binary form, because their text form
// could depend on the library.

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

// Computes the content hash of an object that consists of several parts. The parts are hashed in
// the order in which they are added, in this form:
// - A number is hashed as eight little-endian bytes: an integer in two's complement, or a
//   floating-point number as an IEEE double. Therefore 0.0 and −0.0 have different hashes, whereas
//   the same value has the same hash as an int and as a long, or as a float and as a double.
// - Text is hashed as its length (a number), followed by its bytes.
// - An array is replaced by the content hash of the bytes of all its elements, which is then hashed
//   as text.
// The caller must add the parts of all objects of one kind in the same sequence, and must add the
// length of a list before its elements.
class HashBuilder {
 public:
  // `kind` names the kind of object, such as a table or a set of particles. It is hashed as the
  // first part.
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
    static_assert(std::endian::native == std::endian::little,
                  "hashing arrays requires a little-endian machine");
    return add(content_hash(std::as_bytes(elements)));
  }

  [[nodiscard]] std::string hash() const { return content_hash(bytes_); }

 private:
  HashBuilder& add_word(std::uint64_t word);

  std::string bytes_;
};

}  // namespace triptych::core
