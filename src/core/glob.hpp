#pragma once
// Patterns for names of devices, tests and configurations.

#include <string>
#include <string_view>
#include <vector>

namespace triptych::core {

// '*' matches any sequence of characters, '?' matches one character, and all others match
// themselves.
[[nodiscard]] bool glob_matches(std::string_view pattern, std::string_view text);
[[nodiscard]] bool any_glob_matches(const std::vector<std::string>& patterns,
                                    std::string_view text);

}  // namespace triptych::core
