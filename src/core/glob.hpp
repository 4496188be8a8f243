#pragma once
// Patterns over names of devices, tests and configurations.

#include <string>
#include <string_view>
#include <vector>

namespace triptych::core {

// '*' stands for any run of characters, '?' for one, everything else for itself.
[[nodiscard]] bool glob_matches(std::string_view pattern, std::string_view text);
[[nodiscard]] bool any_glob_matches(const std::vector<std::string>& patterns,
                                    std::string_view text);

}  // namespace triptych::core
