#pragma once
// Distinguishes reference images that this user's own program drew from those that came with a
// store. The seals of a store are hashes that anybody can compute, so a person who gives a store
// away could widen a bound in it until every image is within it.

#include <optional>
#include <string>

#include "record/store.hpp"

namespace triptych::measure {

// HMAC-SHA256 (RFC 2104) of a reference image with its bound. The key is random; it is in this
// user's cache folder and is created when it is first needed. nullopt if no such folder can be
// used. In that case no stored reference image is trusted, and all are drawn again.
[[nodiscard]] std::optional<std::string> own_seal(const record::TruthImage& truth);

// HMAC-SHA256 in hexadecimal digits.
[[nodiscard]] std::string hmac_sha256(std::string_view key, std::string_view message);

}  // namespace triptych::measure
