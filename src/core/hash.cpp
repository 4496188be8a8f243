#include "core/hash.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace triptych::core {
namespace {

void append_hexadecimal(std::uint64_t word, std::string& text) {
  for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[(word >> shift) & 0xF];
}

}  // namespace

std::string content_hash(std::span<const std::byte> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  std::string text;
  append_hexadecimal(hash.high64, text);
  append_hexadecimal(hash.low64, text);
  return text;
}

std::string content_hash(std::string_view text) {
  return content_hash(std::as_bytes(std::span(text.data(), text.size())));
}

HashBuilder& HashBuilder::add(std::string_view text) {
  add(text.size());
  bytes_ += text;
  return *this;
}

HashBuilder& HashBuilder::add_word(std::uint64_t word) {
  for (int shift = 0; shift < 64; shift += 8) bytes_ += static_cast<char>((word >> shift) & 0xFF);
  return *this;
}

}  // namespace triptych::core
