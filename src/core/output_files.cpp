#include "core/output_files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/error.hpp"
#include "core/file.hpp"

namespace triptych::core {
namespace {

namespace fs = std::filesystem;

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (!fs::exists(a, error) || !fs::exists(b, error)) {
    return fs::weakly_canonical(fs::absolute(a), error) ==
           fs::weakly_canonical(fs::absolute(b), error);
  }
  return fs::is_regular_file(a, error) && fs::equivalent(a, b, error);
}

}  // namespace

void require_writable(const fs::path& folder) {
  const fs::path where = folder.empty() ? fs::path(".") : folder;
  std::error_code error;
  fs::create_directories(where, error);
  if (!error && ::access(where.c_str(), W_OK) != 0) error = {errno, std::generic_category()};
  if (error) {
    throw IoError(fmt::format("cannot write to folder {}: {}; choose another folder",
                              where.string(), error.message()));
  }
}

void require_writable_file(const fs::path& file) {
  std::error_code error;
  const bool in_place = fs::exists(file, error) && !fs::is_regular_file(file, error);
  if (!in_place) require_writable(file.parent_path());
}

void refuse_overwriting(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written) {
  std::vector<NamedFile> taken = read;
  for (const NamedFile& each : written) {
    for (const auto& [name, file] : taken) {
      if (each.file.empty() || file.empty() || !is_same_file(each.file, file)) continue;
      throw InputError(fmt::format("{} {} names the same file as {}; choose another file",
                                   each.name, each.file, name));
    }
    taken.push_back(each);
  }
}

void write_text(const fs::path& file, const std::string& text) {
  require_writable_file(file);
  write_file(text, file);
}

}  // namespace triptych::core
