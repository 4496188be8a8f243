#pragma once
// Distinguishes reference images that this user's own program rendered from reference images that
// came with a store. All other seals in a store are hashes that anybody can compute. Therefore,
// whoever provides a store could widen the bounds in it until every image is within its bound.

#include <optional>
#include <string>

#include "record/store.hpp"

namespace triptych::measure {

// Returns the HMAC-SHA256 (RFC 2104) of a reference image with its bound. The key is random; it is
// stored in this user's cache folder and is created when it is first needed. Returns nullopt if no
// such folder can be used. In that case, no stored reference image is trusted, and all reference
// images are rendered again.
[[nodiscard]] std::optional<std::string> own_seal(const record::TruthImage& truth);

// Returns the HMAC-SHA256 in hexadecimal digits.
[[nodiscard]] std::string hmac_sha256(std::string_view key, std::string_view message);

}  // namespace triptych::measure
