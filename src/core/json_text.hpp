#pragma once
// Converts JSON to text. Strings from drivers and file names need not be UTF-8; invalid bytes are
// replaced, because that is better than no output. Hidden characters (core/text.hpp) are written as
// \uXXXX, which is read back as the same character.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/hash.hpp"
#include "core/json.hpp"

namespace triptych::core {

// On one line, or on lines indented by this number of spaces.
[[nodiscard]] std::string json_text(const Json& json, int indent = -1);

// The content hash of a value. It is computed from the CBOR encoding (RFC 8949), which stores a
// number as its bits. Keys are sorted.
[[nodiscard]] inline std::string json_hash(const Json& json) {
  const std::vector<std::uint8_t> bytes = Json::to_cbor(json);
  return content_hash(std::as_bytes(std::span(bytes)));
}

// The text as it would appear in JSON, with invalid bytes replaced. Valid UTF-8 is unchanged.
[[nodiscard]] inline std::string mended_utf8(const std::string& text) {
  return Json::parse(json_text(text)).get<std::string>();
}

}  // namespace triptych::core
