#include "record/factor_list.hpp"

#include <algorithm>
#include <array>

namespace triptych::record {
namespace {

struct Escape {
  char character;
  std::string_view text;
};
constexpr std::array<Escape, 3> escapes{{{',', "%2C"}, {'=', "%3D"}, {'%', "%25"}}};

// Returns the escape sequence at the beginning of the text, or nullptr if there is none.
const Escape* escape_at(std::string_view text) {
  const auto* found = std::ranges::find_if(
      escapes, [&](const Escape& each) { return text.starts_with(each.text); });
  return found == escapes.end() ? nullptr : found;
}

}  // namespace

std::string escaped(std::string_view value) {
  std::string text;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto* escape = std::ranges::find(escapes, value[i], &Escape::character);
    const bool stands_for_itself =
        escape == escapes.end() || (value[i] == '%' && escape_at(value.substr(i)) == nullptr);
    if (stands_for_itself) {
      text += value[i];
    } else {
      text += escape->text;
    }
  }
  return text;
}

std::string unescaped(std::string_view text) {
  std::string value;
  while (!text.empty()) {
    const Escape* escape = escape_at(text);
    value += escape == nullptr ? text.front() : escape->character;
    text.remove_prefix(escape == nullptr ? 1 : escape->text.size());
  }
  return value;
}

std::string factor_list(const std::map<std::string, std::string>& factors) {
  std::string list;
  for (const auto& [factor, value] : factors) {
    if (!list.empty()) list += ',';
    list += factor + '=' + escaped(value);
  }
  return list;
}

std::map<std::string, std::string> parse_factor_list(std::string_view list) {
  std::map<std::string, std::string> factors;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(','), list.size());
    const std::string_view item = list.substr(0, end);
    const std::size_t equals = item.find('=');
    if (equals != std::string_view::npos) {
      factors.emplace(item.substr(0, equals), unescaped(item.substr(equals + 1)));
    }
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return factors;
}

}  // namespace triptych::record
