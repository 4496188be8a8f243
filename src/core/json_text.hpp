#pragma once
// Converts JSON to text. Strings from drivers and file names may contain invalid UTF-8. Invalid
// bytes are replaced instead of reported, because an error would prevent all output. Hidden
// characters (core/text.hpp) are written as \uXXXX, which a JSON parser reads as the same
// character.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/hash.hpp"
#include "core/json.hpp"

namespace triptych::core {

// Returns the JSON text of a value. The text has a single line if `indent` is negative, or several
// lines that are indented by `indent` spaces per level.
[[nodiscard]] std::string json_text(const Json& json, int indent = -1);

// Returns the content hash of a value. It is computed from the CBOR encoding (RFC 8949) with sorted
// keys, because CBOR stores numbers in binary form.
[[nodiscard]] inline std::string json_hash(const Json& json) {
  const std::vector<std::uint8_t> bytes = Json::to_cbor(json);
  return content_hash(std::as_bytes(std::span(bytes)));
}

// Returns `text` with invalid UTF-8 bytes replaced, exactly as it would be read back from JSON.
// Valid UTF-8 is returned unchanged.
[[nodiscard]] inline std::string repaired_utf8(const std::string& text) {
  return Json::parse(json_text(text)).get<std::string>();
}

}  // namespace triptych::core
