#pragma once
// Glob patterns for the names of devices, tests and configurations.

#include <string>
#include <string_view>
#include <vector>

namespace triptych::core {

// Returns whether the pattern matches the whole text. '*' matches any sequence of characters, '?'
// matches one character, and every other character matches itself.
[[nodiscard]] bool glob_matches(std::string_view pattern, std::string_view text);
[[nodiscard]] bool any_glob_matches(const std::vector<std::string>& patterns,
                                    std::string_view text);

}  // namespace triptych::core
