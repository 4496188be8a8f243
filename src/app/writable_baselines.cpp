#include "app/writable_baselines.hpp"

#include <system_error>

#include "app/paths.hpp"
#include "core/error.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* default_folder = "baselines";
constexpr const char* temporary_folder = ".baselines.starting";

// Copies a folder. Installed files may be read-only, but the copies are writable.
void copy_tree(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    const fs::path target = to / entry.path().lexically_relative(from);
    if (entry.is_directory()) {
      fs::create_directories(target);
    } else if (entry.is_regular_file()) {
      fs::copy_file(entry.path(), target);
      fs::permissions(target, fs::perms::owner_write, fs::perm_options::add);
    }
  }
}

}  // namespace

WritableBaselines::WritableBaselines(const std::string& named)
    : name_(named.empty() ? default_folder : named), working_(name_) {
  if (!named.empty() || fs::exists(fs::symlink_status(name_))) return;
  const fs::path installed = default_baselines();
  if (!fs::is_directory(installed)) return;
  try {
    fs::remove_all(temporary_folder);
    copy_tree(installed, temporary_folder);
  } catch (const fs::filesystem_error& error) {
    throw core::IoError(error.what());
  }
  working_ = temporary_folder;
  copied_from_ = installed;
}

WritableBaselines::~WritableBaselines() {
  std::error_code ignored;  // the next `accept` replaces files that could not be removed
  if (working_ != name_) fs::remove_all(working_, ignored);
}

void WritableBaselines::commit() {
  if (working_ == name_) return;
  try {
    fs::rename(working_, name_);
  } catch (const fs::filesystem_error& error) {
    throw core::IoError(error.what());
  }
  working_ = name_;
}

}  // namespace triptych::app
