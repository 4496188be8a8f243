#pragma once
#include <string>
#include <vector>

#include "view/session.hpp"

namespace triptych::view {

// Creates two suites with this name, which search for data files in these folders. Throws
// InputError for an unknown name.
[[nodiscard]] Suites make_suites(const std::string& name, const std::vector<std::string>& folders);

}  // namespace triptych::view
