#pragma once
// SHA-256 (FIPS 180-4), for formats that name it: a page's Content-Security-Policy names its script
// by it. Contents of our own files are told apart by core/hash.hpp, which is faster.

#include <array>
#include <cstdint>
#include <string_view>

namespace triptych::core {

[[nodiscard]] std::array<std::uint8_t, 32> sha256(std::string_view bytes);

}  // namespace triptych::core
