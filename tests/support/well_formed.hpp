#pragma once
// Checks whether a string is well-formed XML, as far as Triptych's output needs it: elements are
// closed in order, attributes are in double quotes and appear once, entities are known, and there
// are no control characters.

#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::test {

class XmlCheck {
 public:
  explicit XmlCheck(std::string_view text) : rest_(text) {}

  // Returns an empty string if the document is well-formed; otherwise a description of the first
  // fault, and the text that follows it.
  [[nodiscard]] std::string fault() {
    while (fault_.empty() && !rest_.empty()) {
      if (rest_.front() == '<') {
        tag();
      } else {
        character('<');
      }
    }
    if (fault_.empty() && !open_.empty()) fail("not closed: " + open_.back());
    if (fault_.empty() && roots_ != 1) fail("not one root");
    return fault_;
  }

 private:
  void fail(const std::string& what) {
    if (fault_.empty()) fault_ = what + " before: " + std::string(rest_.substr(0, 60));
  }
  bool take(std::string_view what) {
    if (!rest_.starts_with(what)) return false;
    rest_.remove_prefix(what.size());
    return true;
  }
  std::string name() {
    std::string text;
    const auto belongs = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == ':' || c == '_';
    };
    while (!rest_.empty() && belongs(rest_.front())) {
      text += rest_.front();
      rest_.remove_prefix(1);
    }
    if (text.empty()) fail("no name");
    return text;
  }
  void spaces() {
    while (take(" ") || take("\n")) {
    }
  }
  // Reads one character of text or of a value that ends at `end`.
  void character(char end) {
    const char c = rest_.front();
    if (c == '<' && end != '<') return fail("'<' in a value");
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')
      return fail("control character");
    if (c == '&' && !(take("&amp;") || take("&lt;") || take("&gt;") || take("&quot;"))) {
      return fail("unknown entity");
    }
    if (c != '&') rest_.remove_prefix(1);
    if (open_.empty() && c != '\n') fail("text outside the root");
  }
  void tag() {
    take("<");
    if (take("?xml")) {
      rest_.remove_prefix(std::min(rest_.find("?>"), rest_.size() - 2) + 2);
      return;
    }
    if (take("/")) return close();
    if (open_.empty()) ++roots_;
    open_.push_back(name());
    attributes();
    if (take("/>")) {
      open_.pop_back();
    } else if (!take(">")) {
      fail("tag does not end");
    }
  }
  void close() {
    const std::string closed = name();
    if (open_.empty() || open_.back() != closed) return fail("closed out of order: " + closed);
    open_.pop_back();
    if (!take(">")) fail("tag does not end");
  }
  void attributes() {
    std::set<std::string> seen;
    for (spaces(); fault_.empty() && !rest_.empty() && rest_.front() != '>' && rest_.front() != '/';
         spaces()) {
      if (!seen.insert(name()).second) return fail("an attribute twice");
      if (!take("=\"")) return fail("no value");
      while (fault_.empty() && !rest_.empty() && rest_.front() != '"') character('"');
      if (!take("\"")) fail("value does not end");
    }
  }

  std::string_view rest_;
  std::vector<std::string> open_;
  int roots_ = 0;
  std::string fault_;
};

[[nodiscard]] inline std::string xml_fault(std::string_view text) {
  return XmlCheck(text).fault();
}

// Strings with special characters, which must appear as plain text in the program's output.
inline const std::vector<std::string>& hostile_strings() {
  static const std::vector<std::string> all{"<script>alert(1)</script>",
                                            "\" onload=\"x",
                                            "'`*_[a](b)|",
                                            "\x1b[31mred",
                                            "line\nend",
                                            "&amp;&",
                                            "\xff\xc0\xbc",
                                            std::string(100'000, 'x')};
  return all;
}

}  // namespace triptych::test
