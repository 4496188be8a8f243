#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::core {

// Returns the name that is most similar to a misspelled name, or nullopt if none is similar. Names
// are similar if at most two characters, or a third of the characters of `wrong`, have to be
// inserted, deleted or replaced.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view wrong,
                                                      const std::vector<std::string>& known);

}  // namespace triptych::core
