#pragma once
// Distinguishes reference images that this user rendered from reference images that came with a
// store. The latter cannot be trusted, because all other seals in a store (record/store_seal.hpp)
// are hashes without a secret key, which anybody can compute. Whoever provides a store could
// therefore widen the error bounds in it until every image is within its bound.

#include <optional>
#include <string>

#include "record/store.hpp"

namespace triptych::measure {

// Returns the HMAC-SHA256 (RFC 2104) of a reference image and its bound. The key is random. It is
// created when it is first needed, and stored in this user's cache folder. Returns nullopt if no
// such folder can be used. In that case, no stored reference image is trusted, and all reference
// images are rendered again.
[[nodiscard]] std::optional<std::string> own_seal(const record::TruthImage& truth);

// Returns the HMAC-SHA256 in hexadecimal digits.
[[nodiscard]] std::string hmac_sha256(std::string_view key, std::string_view message);

}  // namespace triptych::measure
