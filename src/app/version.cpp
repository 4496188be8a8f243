#include "app/version.hpp"

#include <string_view>

#include "triptych_commit.hpp"

namespace triptych::app {

std::string version() {
  constexpr std::string_view commit = TRIPTYCH_COMMIT;
  std::string text = TRIPTYCH_VERSION;
  if (!commit.empty()) text.append(", commit ").append(commit);
  return text;
}

}  // namespace triptych::app
