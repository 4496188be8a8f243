#include "scene/xyz_comment.hpp"

#include <algorithm>
#include <cstddef>

#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

constexpr std::string_view properties_key = "properties";

class CommentParser {
 public:
  explicit CommentParser(std::string_view text) : text_(text) {}

  XyzComment parse() {
    XyzComment comment;
    for (skip_blanks(); !done() && comment.error.empty(); skip_blanks()) {
      const std::optional<std::string> key = word(false);
      skip_blanks();
      std::optional<std::string> value = std::string();
      const bool has_value = !done() && text_[at_] == '=';
      if (has_value) {
        ++at_;
        skip_blanks();
        value = word(true);
      }
      if (!key || !value) {
        comment.error = "a quote or bracket is not closed";
      } else if (has_value && lower_case(*key) == properties_key) {
        if (comment.properties) comment.error = "Properties appears twice";
        comment.properties = *value;
      }
    }
    return comment;
  }

 private:
  [[nodiscard]] bool done() const { return at_ >= text_.size(); }
  void skip_blanks() {
    while (!done() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  // Reads a key or a value. A value may also be in single quotes or in brackets. Returns nullopt if
  // a quote or bracket is not closed.
  std::optional<std::string> word(bool is_value) {
    if (done()) return std::string();
    const char first = text_[at_];
    if (first == '"' || (is_value && first == '\'')) return quoted(first);
    if (is_value && (first == '[' || first == '{')) return bracketed();
    const std::string_view ends = is_value ? " \t" : " \t=";
    const std::size_t end = std::min(text_.find_first_of(ends, at_), text_.size());
    std::string found(text_.substr(at_, end - at_));
    // A pair that begins with '=' has no key. The '=' is skipped.
    at_ = std::max(end, is_value ? at_ : at_ + (found.empty() ? 1 : 0));
    return found;
  }

  // Reads a quoted string, in which a backslash escapes the next character and "\n" is a line end.
  // Returns nullopt if the quote is not closed.
  std::optional<std::string> quoted(char quote) {
    std::string found;
    for (++at_; !done(); ++at_) {
      const char c = text_[at_];
      if (c == quote) {
        ++at_;
        return found;
      }
      if (c == '\\' && at_ + 1 < text_.size()) {
        ++at_;
        found += text_[at_] == 'n' ? '\n' : text_[at_];
      } else {
        found += c;
      }
    }
    return std::nullopt;
  }

  std::optional<std::string> bracketed() {
    const std::size_t begin = at_;
    int depth = 0;
    while (!done()) {
      const char c = text_[at_];
      if (c == '"') {
        if (!quoted('"')) return std::nullopt;
        continue;
      }
      ++at_;
      if (c == '[' || c == '{') ++depth;
      if (c == ']' || c == '}') --depth;
      if (depth == 0) return std::string(text_.substr(begin, at_ - begin));
    }
    return std::nullopt;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

XyzComment parse_xyz_comment(std::string_view comment) {
  XyzComment parsed = CommentParser(comment).parse();
  // A plain XYZ file may have any text in its comment, so only a comment with "Properties=" must be
  // valid.
  const bool is_extended = lower_case(comment).find("properties=") != std::string::npos;
  if (!parsed.error.empty() && !is_extended) return {};
  return parsed;
}

}  // namespace triptych::scene
