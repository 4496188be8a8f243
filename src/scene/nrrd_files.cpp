#include "scene/nrrd_files.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "scene/header_fields.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene::nrrd {
namespace {

RawEncoding parse_encoding(const Field& field) {
  static constexpr std::array<std::pair<std::string_view, RawEncoding>, 9> encodings{
      {{"raw", RawEncoding::plain},
       {"gzip", RawEncoding::gzip},
       {"gz", RawEncoding::gzip},
       {"bzip2", RawEncoding::bzip2},
       {"bz2", RawEncoding::bzip2},
       {"text", RawEncoding::text},
       {"txt", RawEncoding::text},
       {"ascii", RawEncoding::text},
       {"hex", RawEncoding::hex}}};
  const std::string name = lower_case(field.value);
  for (const auto& [spelling, encoding] : encodings) {
    if (name == spelling) return encoding;
  }
  throw core::InputError(field.place, fmt::format("encoding '{}' is not supported; expected raw, "
                                                  "gzip, bzip2, ascii or hex",
                                                  quotable(field.value)));
}

std::int64_t parse_skip(const Field* field, std::int64_t lowest, std::string_view expected) {
  if (field == nullptr) return 0;
  const auto count = parse_number<std::int64_t>(field->value);
  if (!count || *count < lowest) {
    throw core::InputError(
        field->place, fmt::format("found '{}'; expected {}", quotable(field->value), expected));
  }
  return *count;
}

// Returns the position after `count` lines, counted from `start`.
std::uint64_t skip_lines(const std::filesystem::path& file, std::uint64_t start, std::int64_t count,
                         const core::FilePlace& place) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(start));
  for (std::int64_t i = 0; i < count; ++i) {
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    if (!in || in.eof()) {
      throw core::InputError(place,
                             fmt::format("'line skip' is too large: {} has only {} lines to skip",
                                         file.filename().string(), i));
    }
  }
  return static_cast<std::uint64_t>(in.tellg());
}

// Returns the files named by a pattern "FORMAT MIN MAX STEP". The pattern may be followed by a
// dimension (the number of axes in each file), which is ignored. Returns nullopt if the text is not
// a pattern. A '%' alone does not make the text a pattern, because a plain file name may also
// contain a '%'.
std::optional<std::vector<std::string>> files_of_pattern(std::string_view value,
                                                         const core::FilePlace& place) {
  constexpr std::size_t most_files = 100'000;
  auto words = split_words(value);
  if (words.size() < 4) return std::nullopt;
  // If four numbers follow the format, the last one is the dimension.
  std::size_t first = words.size() - 3;
  const auto is_number = [](std::string_view word) { return parse_number<int>(word).has_value(); };
  if (first >= 2 && is_number(words[first - 1])) --first;
  const bool range =
      is_number(words[first]) && is_number(words[first + 1]) && is_number(words[first + 2]);
  const std::string_view name =
      trimmed(value.substr(0, static_cast<std::size_t>(words[first].data() - value.data())));
  const std::size_t percent = name.find('%');
  if (!range || percent == std::string_view::npos) return std::nullopt;
  const std::size_t end = name.find_first_not_of("0123456789", percent + 1);
  if (end == std::string_view::npos || (name[end] != 'd' && name[end] != 'u' && name[end] != 'i')) {
    throw core::InputError(place, "expected a pattern such as slice%03d.raw MIN MAX STEP");
  }
  const std::string_view width = name.substr(percent + 1, end - percent - 1);
  const auto digits = width.empty() ? std::optional<int>(0) : parse_number<int>(width);
  const int lo = *parse_number<int>(words[first]);
  const int hi = *parse_number<int>(words[first + 1]);
  const int step = *parse_number<int>(words[first + 2]);
  if (step == 0 || !digits || *digits > 20) {
    throw core::InputError(place, "expected a pattern with a STEP other than 0");
  }
  std::vector<std::string> names;
  for (std::int64_t i = lo; step > 0 ? i <= hi : i >= hi; i += step) {
    if (names.size() == most_files)
      throw core::InputError(place, "the pattern yields more than 100000 file names");
    const std::string number = width.starts_with('0') ? fmt::format("{:0{}}", i, *digits)
                                                      : fmt::format("{:{}}", i, *digits);
    names.push_back(fmt::format("{}{}{}", name.substr(0, percent), number, name.substr(end + 1)));
  }
  return names;
}

// Finds the files that are named by the field 'data file', and adds them to `source` in the same
// order.
void locate_files(const Header& header, const Field& data, const std::filesystem::path& file,
                  RawVoxels& source) {
  std::vector<Field> named;
  if (!header.listed_files().empty()) {
    named = header.listed_files();
  } else if (auto names = files_of_pattern(data.value, data.place)) {
    for (std::string& name : *names) named.push_back({std::move(name), data.place});
  } else if (data.value == "LIST" || data.value.starts_with("LIST ")) {
    throw core::InputError(data.place,
                           "expected the names of the data files after LIST, one per line");
  } else {
    named.push_back(data);
  }
  if (named.empty()) throw core::InputError(data.place, "the pattern yields no file names");
  for (const Field& each : named) {
    const auto found = find_data_file(file, each.value, each.place);
    if (source.file.empty()) {
      source.file = found;
    } else {
      source.more_files.push_back(found);
    }
  }
}

}  // namespace

RawVoxels locate(const Header& header, const std::filesystem::path& file) {
  RawVoxels source;
  source.encoding = parse_encoding(header.require("encoding"));
  source.sizes_place = header.require("sizes").place;
  if (const Field* data = header.find("data file")) {
    locate_files(header, *data, file, source);
  } else if (header.data_start()) {
    source.file = file;
    source.packing = packing_of_file(file);
    source.start = *header.data_start();
  } else {
    throw core::InputError(header.last_line(),
                           "the blank line between the header and the data is missing");
  }
  const Field* lines = header.find("line skip");
  const std::int64_t line_count = parse_skip(lines, 0, "a whole number, 0 or more");
  if (line_count > 0) {
    if (source.packing != Packing::none || !source.more_files.empty()) {
      throw core::InputError(lines->place,
                             "'line skip' is supported only for a single uncompressed file");
    }
    source.start = skip_lines(source.file, source.start, line_count, lines->place);
  }
  source.skip =
      parse_skip(header.find("byte skip"), RawVoxels::at_end, "a whole number, 0 or more, or -1");
  return source;
}

}  // namespace triptych::scene::nrrd
