#pragma once
// SHA-256 (FIPS 180-4), for formats that require it. For example, the Content-Security-Policy of an
// HTML page identifies the page's script by this hash. core/hash.hpp is faster for comparing
// contents.

#include <array>
#include <cstdint>
#include <string_view>

namespace triptych::core {

[[nodiscard]] std::array<std::uint8_t, 32> sha256(std::string_view bytes);

}  // namespace triptych::core
