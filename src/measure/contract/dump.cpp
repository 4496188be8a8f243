#include "measure/contract/dump.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/output_files.hpp"

namespace triptych::measure {

std::optional<std::filesystem::path> dump_folder() {
  const char* folder = std::getenv("TRIPTYCH_DUMP");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return folder;
}

std::string write_dump(std::string_view name, std::string_view extension,
                       std::span<const std::byte> content, const std::string& about) {
  return write_dump(name, extension,
                    std::string_view(reinterpret_cast<const char*>(content.data()), content.size()),
                    about);
}

std::string write_dump(std::string_view name, std::string_view extension, std::string_view content,
                       const std::string& about) {
  const auto folder = dump_folder();
  if (!folder) return {};
  constexpr std::size_t digits = 8;
  const std::string file =
      fmt::format("{}-{}.{}", name, core::content_hash(content).substr(0, digits), extension);
  core::write_text(*folder / file, std::string(content));
  std::ofstream list(*folder / "what-was-given.txt", std::ios::app);
  list << file << ": " << about << '\n';
  if (!list.flush()) {
    throw core::IoError((*folder / "what-was-given.txt").string() + " cannot be written");
  }
  return file;
}

}  // namespace triptych::measure
