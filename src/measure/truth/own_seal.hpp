#pragma once
// Tells reference images that this user's own program drew from those that came with a store. A
// store's seals are hashes that anybody can compute: whoever gives a store away could widen a bound
// in it until every image lies within.

#include <optional>
#include <string>

#include "record/store.hpp"

namespace triptych::measure {

// HMAC-SHA256 (RFC 2104) of a reference image with its bound, under a random key that lies in this
// user's cache folder and is made when it is first needed. nullopt where no such folder can be used:
// then nothing can be recognized, and every reference image is drawn again.
[[nodiscard]] std::optional<std::string> own_seal(const record::TruthImage& truth);

// HMAC-SHA256 in hexadecimal digits.
[[nodiscard]] std::string hmac_sha256(std::string_view key, std::string_view message);

}  // namespace triptych::measure
