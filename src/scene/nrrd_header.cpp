#include "scene/nrrd_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <system_error>

#include "scene/text_lines.hpp"

namespace triptych::scene::nrrd {
namespace {

// The start of a file, as much of it as a header may take.
std::string read_start(const std::filesystem::path& file) {
  constexpr std::uintmax_t longest_header = std::uintmax_t{1} << 20;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  if (error || !in) throw core::IoError(file.string() + ": cannot be read");
  std::string text(std::min(size, longest_header), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw core::IoError(file.string() + ": cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

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
  const std::string start = read_start(file);
  std::string_view rest = start;
  while (!rest.empty()) {
    const std::size_t length = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, length);
    rest.remove_prefix(std::min(length + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    const core::FilePlace place{.file = file_, .line = ++lines_};
    if (lines_ == 1) {
      if (line.size() != 8 || !line.starts_with("NRRD000") || line[7] < '1' || line[7] > '5') {
        throw core::InputError(place, "not an NRRD file; expected NRRD0001 … NRRD0005");
      }
    } else if (line.empty()) {
      data_start_ = start.size() - rest.size();
      return;
    } else if (!line.starts_with('#')) {
      add(line, place);
    }
  }
  if (lines_ == 0) throw core::InputError({.file = file_}, "is empty; expected an NRRD header");
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
  if (line.substr(colon).starts_with(":=")) return;
  const std::string name = canonical(line.substr(0, colon));
  if (name != "sample units" && std::find(known.begin(), known.end(), name) == known.end()) {
    throw core::InputError(place,
                           fmt::format("unknown NRRD field '{}'", quotable(line.substr(0, colon))));
  }
  if (!fields_.emplace(name, Field{std::string(trimmed(line.substr(colon + 1))), place}).second) {
    throw core::InputError(place, fmt::format("field '{}' is given twice", name));
  }
}

}  // namespace triptych::scene::nrrd
