#pragma once
// JSON as text. Drivers' strings and file names need not be UTF-8: a replaced letter is better than
// no answer.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/hash.hpp"
#include "core/json.hpp"

namespace triptych::core {

// In one line, or on lines indented by so many spaces.
[[nodiscard]] inline std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

// Content hash of a value: over CBOR (RFC 8949), in which a number has its own bits. Keys are
// sorted.
[[nodiscard]] inline std::string json_hash(const Json& json) {
  const std::vector<std::uint8_t> bytes = Json::to_cbor(json);
  return content_hash(std::as_bytes(std::span(bytes)));
}

// As JSON's text would have it; valid text comes back as it was.
[[nodiscard]] inline std::string mended_utf8(const std::string& text) {
  return Json::parse(json_text(text)).get<std::string>();
}

}  // namespace triptych::core
