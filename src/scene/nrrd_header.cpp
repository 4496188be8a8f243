#include "scene/nrrd_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scene/compression.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene::nrrd {
namespace {

// Headers can be long, because a key/value pair may contain a whole document.
constexpr std::size_t usual_header = std::size_t{1} << 16U;
constexpr std::size_t longest_header = std::size_t{64} << 20U;

std::string canonical(std::string_view name) {
  const std::string lower = lower_case(trimmed(name));
  static constexpr std::array<std::array<std::string_view, 2>, 10> aliases{
      {{"datafile", "data file"},
       {"lineskip", "line skip"},
       {"byteskip", "byte skip"},
       {"blocksize", "block size"},
       {"axismins", "axis mins"},
       {"axismaxs", "axis maxs"},
       {"centers", "centerings"},
       {"oldmin", "old min"},
       {"oldmax", "old max"},
       {"sampleunits", "sample units"}}};
  for (const auto& [alias, spelling] : aliases) {
    if (lower == alias) return std::string(spelling);
  }
  return lower;
}

}  // namespace

Header::Header(const std::filesystem::path& file) : file_(file.string()) {
  std::string start = content_start(file, usual_header);
  // Reads more than the usual size only if the header does not end within that size.
  const bool ends = start.find("\n\n") != std::string::npos ||
                    start.find("\n\r\n") != std::string::npos || start.size() < usual_header;
  if (!ends) start = content_start(file, longest_header);
  parse(start);
  const bool too_long =
      !data_start_ && start.size() == longest_header && find("data file") == nullptr;
  if (too_long) {
    throw core::InputError(
        last_line(),
        fmt::format("the header is not terminated by a blank line within its first {} bytes",
                    longest_header));
  }
}

void Header::parse(std::string_view start) {
  std::string_view rest = without_mark(start);
  while (!rest.empty()) {
    const std::size_t length = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, length);
    rest.remove_prefix(std::min(length + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    const core::FilePlace place{.file = file_, .line = ++lines_};
    if (lines_ == 1) {
      if (line.size() != 8 || !line.starts_with("NRRD000") || line[7] < '1' || line[7] > '5') {
        throw core::InputError(place, "this is not an NRRD file; expected NRRD0001 … NRRD0005");
      }
    } else if (lists_files_) {
      if (!trimmed(line).empty()) files_.push_back({std::string(trimmed(line)), place});
    } else if (line.empty()) {
      data_start_ = start.size() - rest.size();
      return;
    } else if (!line.starts_with('#')) {
      add(line, place);
    }
  }
  if (lines_ == 0)
    throw core::InputError({.file = file_}, "the file is empty; expected an NRRD header");
}

void Header::add(std::string_view line, const core::FilePlace& place) {
  static constexpr std::array<std::string_view, 29> known{"dimension",
                                                          "type",
                                                          "sizes",
                                                          "encoding",
                                                          "endian",
                                                          "data file",
                                                          "line skip",
                                                          "byte skip",
                                                          "spacings",
                                                          "space directions",
                                                          "content",
                                                          "number",
                                                          "block size",
                                                          "min",
                                                          "max",
                                                          "old min",
                                                          "old max",
                                                          "axis mins",
                                                          "axis maxs",
                                                          "centerings",
                                                          "labels",
                                                          "units",
                                                          "kinds",
                                                          "thicknesses",
                                                          "space",
                                                          "space dimension",
                                                          "space units",
                                                          "space origin",
                                                          "measurement frame"};
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) {
    throw core::InputError(place, "expected 'field: value', 'key:=value' or a comment");
  }
  const std::string name = canonical(line.substr(0, colon));
  const bool is_field =
      name == "sample units" || std::find(known.begin(), known.end(), name) != known.end();
  // A line "key:=value" is ignored. Its key may also contain colons, so the ":=" need not be at the
  // first colon of the line.
  const bool is_pair = line.substr(colon).starts_with(":=") ||
                       (!is_field && line.find(":=") != std::string_view::npos);
  if (is_pair) return;
  if (!is_field) {
    throw core::InputError(place,
                           fmt::format("unknown NRRD field '{}'", quotable(line.substr(0, colon))));
  }
  const Field field{std::string(trimmed(line.substr(colon + 1))), place};
  if (!fields_.emplace(name, field).second) {
    throw core::InputError(place, fmt::format("field '{}' is given twice", name));
  }
  const std::string first_word = field.value.substr(0, field.value.find_first_of(" \t"));
  lists_files_ = lists_files_ || (name == "data file" && first_word == "LIST");
}

}  // namespace triptych::scene::nrrd
