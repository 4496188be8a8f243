#include "scene/line_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace triptych::scene {

LineReader::LineReader(std::string_view text, std::string file, ProgressSteps progress)
    : text_(text), file_(std::move(file)), progress_(progress) {}

std::optional<std::string_view> LineReader::next() {
  if (begin_ >= text_.size()) return std::nullopt;
  const std::size_t end = std::min(text_.find('\n', begin_), text_.size());
  std::string_view line = text_.substr(begin_, end - begin_);
  if (line.ends_with('\r')) line.remove_suffix(1);
  begin_ = end + 1;
  ++line_;
  progress_.advance_to(begin_);
  return line;
}

std::string_view LineReader::require(std::string_view what) {
  const auto line = next();
  if (!line) reject(fmt::format("unexpected end of file; expected {}", what));
  return *line;
}

bool LineReader::at_end() {
  for (;;) {
    const std::size_t end = std::min(text_.find('\n', begin_), text_.size());
    if (begin_ >= text_.size()) return true;
    if (!trimmed(text_.substr(begin_, end - begin_)).empty()) return false;
    begin_ = end + 1;
    ++line_;
  }
}

void LineReader::skip(std::uint64_t count, std::string_view what) {
  for (std::uint64_t i = 0; i < count; ++i) static_cast<void>(require(what));
}

std::string LineReader::truncation_hint() const {
  const std::string_view rest = text_.substr(std::min(begin_, text_.size()));
  const bool ends = rest.find_first_not_of(" \t\r\n") == std::string_view::npos;
  return ends ? "; the file ends here, so it may be truncated" : "";
}

std::optional<std::uint64_t> LineReader::count_frames(int before, int after) const {
  LineReader rest = *this;
  std::uint64_t frames = 0;
  const auto skip_lines = [&rest](std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (!rest.next()) return false;
    }
    return true;
  };
  for (; !rest.at_end(); ++frames) {
    if (!skip_lines(static_cast<std::uint64_t>(before))) return std::nullopt;
    const auto line = rest.next();
    const auto count = line ? parse_number<std::uint64_t>(trimmed(*line)) : std::nullopt;
    if (!count || !skip_lines(*count) || !skip_lines(static_cast<std::uint64_t>(after))) {
      return std::nullopt;
    }
  }
  return frames;
}

std::uint64_t LineReader::count_lines(std::string_view start) const {
  std::uint64_t lines = 0;
  for (std::size_t at = begin_; at < text_.size();) {
    at = text_.find(start, at);
    if (at == std::string_view::npos) break;
    if (at == 0 || text_[at - 1] == '\n') ++lines;
    at += start.size();
  }
  return lines;
}

void LineReader::reject_at(int line, const std::string& message) const {
  throw core::InputError({.file = file_, .line = line}, message);
}

double LineReader::number(std::string_view word, std::string_view what) const {
  const auto value = parse_number<double>(trimmed(word));
  if (!value)
    reject(fmt::format("{}: expected a number, found '{}'", what, quotable(trimmed(word))));
  return *value;
}

std::uint64_t LineReader::count(std::string_view word, std::string_view what) const {
  const auto value = parse_number<std::uint64_t>(trimmed(word));
  if (!value) reject(fmt::format("expected {}, found '{}'", what, quotable(trimmed(word))));
  if (*value > most_particles) {
    reject(fmt::format("too many particles: {} (the limit is {})", *value, most_particles));
  }
  return *value;
}

std::int64_t LineReader::integer(std::string_view word, std::string_view what) const {
  const auto value = parse_number<std::int64_t>(trimmed(word));
  if (!value)
    reject(fmt::format("{}: expected a whole number, found '{}'", what, quotable(trimmed(word))));
  return *value;
}

std::size_t LineReader::reservation(std::uint64_t claimed, std::size_t shortest) const {
  const std::size_t left = begin_ < text_.size() ? text_.size() - begin_ : 0;
  return static_cast<std::size_t>(std::min<std::uint64_t>(claimed, left / shortest + 1));
}

void split_words_into(std::string_view text, std::vector<std::string_view>& words) {
  constexpr std::string_view blanks = " \t\r";
  words.clear();
  std::size_t begin = text.find_first_not_of(blanks);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
}

}  // namespace triptych::scene
