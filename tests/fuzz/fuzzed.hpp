#pragma once
// Shared by all fuzz targets: storing an input as a file, and checking which exceptions a reader
// throws.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

namespace triptych::fuzz {

// Return values for libFuzzer: `judged` lets it keep the input if the input reaches new code, and
// `rejected` makes it discard the input.
inline constexpr int judged = 0;
inline constexpr int rejected = -1;

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// A fuzzer input. Its first line is the kind of file, such as "pdb.gz", followed by the content of
// the file.
struct Input {
  std::string kind;
  std::string_view content;
};

template <typename Kinds>
std::optional<Input> split(const std::uint8_t* data, std::size_t size, const Kinds& kinds) {
  const std::string_view text = text_of(data, size);
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  for (const auto& kind : kinds) {
    if (text.substr(0, end) == kind) return Input{std::string(kind), text.substr(end + 1)};
  }
  return std::nullopt;
}

// Returns the file-name extensions in a table of formats, without dots, each also with ".gz" for
// compressed files.
template <typename Format>
std::vector<std::string> kinds_of(std::span<const Format> formats) {
  std::vector<std::string> kinds;
  for (const Format& format : formats) {
    std::istringstream endings{std::string(format.endings)};
    for (std::string ending; endings >> ending;) {
      kinds.push_back(ending.substr(1));
      kinds.push_back(ending.substr(1) + ".gz");
    }
  }
  return kinds;
}

// Returns a temporary folder that is deleted when the process ends.
inline const std::filesystem::path& folder() {
  static const core::TemporaryFolder made;
  return made.path();
}

inline std::filesystem::path write(const std::string& name, std::string_view content) {
  const std::filesystem::path file = folder() / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

// Runs a reader, which may throw Triptych's own error types. Any other exception terminates the
// process, which libFuzzer reports as a crash.
template <typename Read>
void expect_typed_errors(const Read& read) {
  try {
    read();
  } catch (const core::Error&) {
  }
}

}  // namespace triptych::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
