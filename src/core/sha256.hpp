#pragma once
// SHA-256 (FIPS 180-4), for formats that require it: the Content-Security-Policy of a page
// identifies its script by this hash. For comparing contents, core/hash.hpp is faster.

#include <array>
#include <cstdint>
#include <string_view>

namespace triptych::core {

[[nodiscard]] std::array<std::uint8_t, 32> sha256(std::string_view bytes);

}  // namespace triptych::core
