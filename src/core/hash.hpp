#pragma once
// Content hashes: to tell whether two things are the same, not to protect them.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace triptych::core {

// XXH3, 128 bits, as 32 lower-case hexadecimal digits.
[[nodiscard]] std::string content_hash(std::span<const std::byte> bytes);
[[nodiscard]] std::string content_hash(std::string_view text);

}  // namespace triptych::core
