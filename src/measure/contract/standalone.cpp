#include "measure/contract/standalone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/file.hpp"
#include "core/output_files.hpp"

namespace triptych::measure {
namespace {

// Shader sources are split into string literals of this many characters. They are long, so that the
// C program has few lines.
constexpr std::size_t characters_of_a_line = 4000;

std::string escaped(char c) {
  switch (c) {
    case '\n':
      return "\\n";
    case '\t':
      return "\\t";
    case '"':
      return "\\\"";
    case '\\':
      return "\\\\";
    case '?':
      return "\\?";  // avoids trigraphs
    default:
      return std::string(1, c);
  }
}

}  // namespace

std::string c_words(std::string_view name, std::span<const std::byte> bytes) {
  const std::size_t count =
      std::max<std::size_t>(1, (bytes.size() + sizeof(std::uint32_t) - 1) / sizeof(std::uint32_t));
  const std::size_t words_of_a_line = std::max<std::size_t>(400, (count + 4) / 5);
  std::string text = fmt::format("static const uint32_t {}[{}] = {{\n", name, count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i * sizeof(std::uint32_t);
    std::uint32_t word = 0;
    if (at < bytes.size()) {
      std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
    }
    text += fmt::format("{:#x},", word);
    if ((i + 1) % words_of_a_line == 0) text += '\n';
  }
  return text + "};\n";
}

std::string c_text(std::string_view name, std::string_view text) {
  std::string result = fmt::format("static const char {}[] =\n", name);
  for (std::size_t at = 0; at < text.size(); at += characters_of_a_line) {
    result += '"';
    for (const char c : text.substr(at, characters_of_a_line)) result += escaped(c);
    result += "\"\n";
  }
  return result + ";\n";
}

void append_expected(const std::filesystem::path& folder, const core::Image& truth,
                     const core::Image& bound) {
  constexpr std::size_t most_pixels = 65536;
  const std::filesystem::path file = folder / "frame.c";
  if (truth.pixel_count() > most_pixels || !std::filesystem::exists(file)) return;
  // The declarations in c_judge are tentative definitions. These are the definitions.
  const std::string text =
      c_words("expected_words", std::as_bytes(std::span(truth.rgba))) +
      c_words("bound_words", std::as_bytes(std::span(bound.rgba))) +
      "const uint32_t *expected_image = expected_words, *expected_bound = bound_words;\n";
  // The program contains the shaders and the data, so it may be larger than a text that a person
  // writes.
  std::vector<std::byte> program = core::read_file(file);
  const auto more = std::as_bytes(std::span(text));
  program.insert(program.end(), more.begin(), more.end());
  core::write_file(program, file);
}

std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values) {
  std::string result;
  for (;;) {
    const std::size_t begin = text.find('@');
    const std::size_t end = begin == std::string_view::npos ? begin : text.find('@', begin + 1);
    if (end == std::string_view::npos) return result.append(text);
    result.append(text.substr(0, begin));
    result += values.at(std::string(text.substr(begin + 1, end - begin - 1)));
    text.remove_prefix(end + 1);
  }
}

}  // namespace triptych::measure
