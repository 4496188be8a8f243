#include "scene/xml_tags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {

XmlTags::XmlTags(ByteSource source, std::string file)
    : source_(std::move(source)), file_(std::move(file)), buffer_(std::size_t{1} << 16U) {}

std::optional<char> XmlTags::letter() {
  if (at_ == size_) {
    at_ = 0;
    size_ = source_(buffer_);
    if (size_ == 0) return std::nullopt;
  }
  ++taken_;
  return static_cast<char>(buffer_[at_++]);
}

// Returns the text between '<' and '>'. A '>' in quotes does not end the tag.
std::string XmlTags::until_end() {
  constexpr std::size_t longest = std::size_t{1} << 16U;
  std::string text;
  char quote = 0;
  while (const auto c = letter()) {
    const bool comment = text.starts_with("!--");
    if (*c == '>' && quote == 0 && (!comment || text.ends_with("--"))) return text;
    if (!comment && (*c == '"' || *c == '\'')) {
      quote = quote == 0 ? *c : quote == *c ? '\0' : quote;
    }
    text += *c;
    if (comment && text.size() > 16) text.erase(3, text.size() - 8);
    if (text.size() > longest) break;
  }
  throw core::InputError({.file = file_}, "a tag is not closed by '>' or is too long");
}

XmlTag XmlTags::parse(std::string_view text) const {
  constexpr std::string_view blanks = " \t\r\n";
  XmlTag tag{.name = {}, .attributes = {}, .end = taken_};
  if (text.ends_with('/')) {
    tag.empty = true;
    text.remove_suffix(1);
  }
  const std::size_t end = std::min(text.find_first_of(blanks), text.size());
  tag.name = text.substr(0, end);
  text.remove_prefix(end);
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    if (text.empty()) return tag;
    const std::size_t equals = text.find('=');
    const std::size_t open =
        equals == std::string_view::npos ? equals : text.find_first_not_of(blanks, equals + 1);
    const bool quoted = open != std::string_view::npos && (text[open] == '"' || text[open] == '\'');
    const std::size_t close = quoted ? text.find(text[open], open + 1) : std::string_view::npos;
    if (close == std::string_view::npos) {
      throw core::InputError(
          {.file = file_},
          fmt::format("<{}>: expected attributes as NAME=\"VALUE\"", quotable(tag.name)));
    }
    std::string_view key = text.substr(0, equals);
    key = key.substr(0, std::min(key.find_first_of(blanks), key.size()));
    tag.attributes[std::string(key)] = text.substr(open + 1, close - open - 1);
    text.remove_prefix(close + 1);
  }
}

std::optional<XmlTag> XmlTags::next() {
  for (;;) {
    for (auto c = letter(); c != '<'; c = letter()) {
      if (!c) return std::nullopt;
    }
    const std::string text = until_end();
    if (text.starts_with('?') || text.starts_with('!')) continue;
    return parse(text);
  }
}

}  // namespace triptych::scene
