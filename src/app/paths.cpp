#include "app/paths.hpp"

#include <cstdlib>
#include <system_error>

#include "measure/worker/own_program.hpp"

namespace triptych::app {
namespace fs = std::filesystem;

std::vector<fs::path> data_folders() {
  const char* root = std::getenv("TRIPTYCH_DATA");
  if (root == nullptr || *root == '\0') return {};
  const fs::path folder(root);
  return {folder, folder / "volumes", folder / "particles"};
}

fs::path default_baselines() {
  std::error_code ignored;  // a folder without search permission counts as missing
  if (fs::is_directory("baselines", ignored)) return "baselines";
  const fs::path installed =
      fs::path(measure::own_program()).parent_path() / TRIPTYCH_TO_DATA / "baselines";
  if (fs::is_directory(installed, ignored)) return installed.lexically_normal();
  return fs::path(TRIPTYCH_SOURCE_FOLDER) / "baselines";
}

}  // namespace triptych::app
