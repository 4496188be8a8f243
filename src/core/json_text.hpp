#pragma once
// Converts JSON to text. Strings from drivers and file names may contain invalid UTF-8. Invalid
// bytes are replaced, because an error would prevent any output. Hidden characters (core/text.hpp)
// are written as \uXXXX, which a JSON parser reads as the same character.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/hash.hpp"
#include "core/json.hpp"

namespace triptych::core {

// Returns the text of a JSON value on one line, or, if `indent` is not negative, on several lines
// that are indented by this number of spaces per level.
[[nodiscard]] std::string json_text(const Json& json, int indent = -1);

// Returns the content hash of a value. It is computed from the CBOR encoding (RFC 8949) with sorted
// keys, because CBOR stores numbers in binary form.
[[nodiscard]] inline std::string json_hash(const Json& json) {
  const std::vector<std::uint8_t> bytes = Json::to_cbor(json);
  return content_hash(std::as_bytes(std::span(bytes)));
}

// Returns the text as it would be read back from JSON, with invalid bytes replaced. Valid UTF-8 is
// unchanged.
[[nodiscard]] inline std::string mended_utf8(const std::string& text) {
  return Json::parse(json_text(text)).get<std::string>();
}

}  // namespace triptych::core
