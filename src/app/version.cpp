#include "app/version.hpp"

#include <string_view>

#include "triptych_commit.hpp"
#include "triptych_device_code.hpp"

namespace triptych::app {

std::string version() {
  constexpr std::string_view commit = TRIPTYCH_COMMIT;
  std::string text = TRIPTYCH_VERSION;
  if (!commit.empty()) text.append(", commit ").append(commit);
  text.append(", device code ").append(TRIPTYCH_DEVICE_CODE);
  return text;
}

}  // namespace triptych::app
