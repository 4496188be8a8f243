#include "app/paths.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <ctime>
#include <system_error>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/quoting.hpp"

namespace triptych::app {
namespace fs = std::filesystem;

std::vector<fs::path> data_folders() {
  const char* root = std::getenv("TRIPTYCH_DATA");
  if (root == nullptr || *root == '\0') return {};
  const fs::path folder(root);
  return {folder, folder / "volumes", folder / "particles"};
}

fs::path default_baselines() {
  std::error_code ignored;  // a folder that may not be searched has none
  if (fs::is_directory("baselines", ignored)) return "baselines";
  const fs::path installed = fs::path(own_program()).parent_path() / TRIPTYCH_TO_DATA / "baselines";
  if (fs::is_directory(installed, ignored)) return installed.lexically_normal();
  return fs::path(TRIPTYCH_SOURCE_FOLDER) / "baselines";
}

std::string own_program() {
  return fs::read_symlink("/proc/self/exe").string();
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  return fmt::format("{:04}-{:02}-{:02}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday);
}

void require_writable(const fs::path& folder) {
  const fs::path where = folder.empty() ? fs::path(".") : folder;
  std::error_code error;
  fs::create_directories(where, error);
  if (!error && ::access(where.c_str(), W_OK) != 0) error = {errno, std::generic_category()};
  if (error) {
    throw core::IoError(fmt::format("cannot write into {}: {}; choose another folder",
                                    where.string(), error.message()));
  }
}

namespace {

bool are_one_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (!fs::exists(a, error) || !fs::exists(b, error)) {
    return fs::weakly_canonical(fs::absolute(a), error) ==
           fs::weakly_canonical(fs::absolute(b), error);
  }
  return fs::is_regular_file(a, error) && fs::equivalent(a, b, error);
}

}  // namespace

void refuse_overwriting(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written) {
  std::vector<NamedFile> taken = read;
  for (const NamedFile& each : written) {
    for (const auto& [name, file] : taken) {
      if (each.file.empty() || file.empty() || !are_one_file(each.file, file)) continue;
      throw core::InputError(
          fmt::format("{} {} is the file of {}: choose another", each.name, each.file, name));
    }
    taken.push_back(each);
  }
}

void require_store(const fs::path& file) {
  if (file.empty() || fs::exists(file)) return;  // without a name it is refused when it is opened
  throw core::NotSupported(
      fmt::format("there is no store {}: measure first with `triptych run PLAN --store {}`",
                  file.string(), core::shell_quoted(file.string())));
}

void write_text(const fs::path& file, const std::string& text) {
  require_writable(file.parent_path());
  core::write_file(text, file);
}

}  // namespace triptych::app
