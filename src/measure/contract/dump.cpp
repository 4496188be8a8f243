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
    throw core::IoError("cannot write " + (*folder / "what-was-given.txt").string());
  }
  return file;
}

void write_compile_script(const std::filesystem::path& folder) {
  constexpr const char* script = R"sh(#!/bin/sh
# Compiles the device code in this folder with public tools: spirv-val (Debian: spirv-tools),
# glslangValidator (glslang-tools) and clang. The exit code is 1 if one of them rejects a file.
cd "$(dirname "$0")" || exit 1
failed=0
for file in *.spv;
  do
  [ -e "$file" ] || continue
  spirv-val --target-env vulkan1.2 "$file" || failed=1
done
for file in shader-*;
  do
  [ -e "$file" ] || continue
  glslangValidator "$file" || failed=1
done
for file in program-*.cl;
  do
  [ -e "$file" ] || continue
  options=$(sed -n "s/^$file: built in [0-9.]* ms with //p" what-was-given.txt | head -n 1)
# The options contain no quotes.
# shellcheck disable=SC2086
  clang -x cl -target spir64 -Xclang -finclude-default-header -fsyntax-only $options "$file" || failed=1
done
exit $failed
)sh";
  core::write_text(folder / "compile.sh", script);
  std::filesystem::permissions(folder / "compile.sh", std::filesystem::perms::owner_exec,
                               std::filesystem::perm_options::add);
}

}  // namespace triptych::measure
