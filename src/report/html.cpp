#include "report/html.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "core/quoting.hpp"
#include "core/sha256.hpp"
#include "core/text.hpp"
#include "triptych_report_embedded.hpp"

namespace triptych::report {

namespace {

// Removes the first character from the text and returns it.
std::string_view take_character(std::string_view& text) {
  const std::string_view character =
      text.substr(0, std::max<std::size_t>(core::utf8_length(text), 1));
  text.remove_prefix(character.size());
  return character;
}

}  // namespace

std::string escape(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const bool is_valid = core::utf8_length(text) > 0;
    const std::string_view character = take_character(text);
    const char first = character.front();
    if (!is_valid) {
      result += core::replacement_character;
    } else if (first == '&') {
      result += "&amp;";
    } else if (first == '<') {
      result += "&lt;";
    } else if (first == '>') {
      result += "&gt;";
    } else if (first == '"') {
      result += "&quot;";
    } else if (first == '\n' || first == '\t' || (first >= 0x20 && first < 0x7F)) {
      result += first;
    } else if (core::is_hidden(character)) {
      result += core::visible(character);
    } else {
      result += character;
    }
  }
  return result;
}

Html breakable(std::string_view text) {
  Html result;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find_first_of(".:,=/", from), text.size() - 1) + 1;
    result += markup("{}<wbr>", text.substr(from, to - from));
    from = to;
  }
  return result;
}

namespace {

std::string base64(std::span<const std::byte> bytes) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t byte_count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < byte_count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      result += k <= byte_count ? digits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return result;
}

}  // namespace

Html data_uri(std::span<const std::byte> png) {
  return Html("data:image/png;base64," + base64(png));
}

Html embedded_markup(std::string_view file) {
  return Html(std::string(embedded(file)));
}

std::string embedded_sha256(std::string_view file) {
  const auto hash = core::sha256(embedded(file));
  return base64(std::as_bytes(std::span(hash)));
}

Html without_repeated_images(const Html& whole) {
  std::string_view page = whole.text();
  static constexpr std::string_view image = "<img ";
  static constexpr std::string_view source = "src=\"data:";
  std::map<std::string_view, std::size_t> first;
  std::string result;
  std::size_t number = 0;
  for (std::size_t at = page.find(image); at != std::string_view::npos; at = page.find(image)) {
    at += image.size();
    result += page.substr(0, at);
    page.remove_prefix(at);
    const std::size_t end = page.find('"', source.size());
    if (page.starts_with(source) && end != std::string_view::npos) {
      const auto [same, is_new] = first.try_emplace(page.substr(0, end + 1), number);
      result += is_new ? std::string(same->first) : fmt::format("data-same=\"{}\"", same->second);
      page.remove_prefix(end + 1);
    }
    ++number;
  }
  return Html(result + std::string(page));
}

namespace {

// Returns whether a cell contains a quantity, such as "12.3 ms", "1 234" or "-0.5 ± 0.1": a number
// that may have a unit of at most two letters.
bool is_quantity(std::string_view cell) {
  cell = cell.substr(0, cell.find(" ±"));
  if (cell.empty() || (cell[0] != '-' && cell[0] != '+' &&
                       std::isdigit(static_cast<unsigned char>(cell[0])) == 0)) {
    return false;
  }
  const auto letters = std::ranges::count_if(
      cell, [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; });
  const bool is_time = cell.find(':') != std::string_view::npos;
  return letters <= 2 && std::ranges::count(cell, '.') <= 1 && !is_time;
}

// Returns which columns contain only quantities. Ignores the header and empty cells.
std::vector<bool> columns_of_quantities(const Rows& rows) {
  std::vector<bool> result;
  for (std::size_t column = 0; column < rows.front().size(); ++column) {
    bool any = false;
    bool all = true;
    for (std::size_t row = 1; row < rows.size(); ++row) {
      const std::string& cell = rows[row].at(column).html().text();
      const bool nothing = cell.empty() || cell == "–";
      any = any || !nothing;
      all = all && (nothing || is_quantity(cell));
    }
    result.push_back(any && all);
  }
  return result;
}

}  // namespace

Html table(const Rows& rows, std::string_view css_class) {
  // A wide table scrolls, so the keyboard must be able to reach it.
  Html text = markup("<div class=\"scroll\" tabindex=\"0\"><table class=\"{}\">\n", css_class);
  const std::vector<bool> numbers = columns_of_quantities(rows);
  bool head = true;
  for (const TableRow& row : rows) {
    text += markup("<tr>");
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool is_heading = head && !row[i].html().text().empty();
      text += markup("<{0}{1}>{2}</{0}>", is_heading ? "th" : "td",
                     numbers.at(i) ? markup(" class=\"number\"") : Html(), row[i].html());
    }
    text += markup("</tr>\n");
    head = false;
  }
  return text + markup("</table></div>\n");
}

std::string duration(double nanoseconds) {
  static constexpr std::string_view units[] = {"ns", "µs", "ms", "s"};
  std::size_t unit = 0;
  while (std::abs(nanoseconds) >= 999.5 && unit + 1 < std::size(units)) {
    nanoseconds /= 1000;
    ++unit;
  }
  const int decimals = nanoseconds >= 99.95 ? 0 : nanoseconds >= 9.995 ? 1 : 2;
  return fmt::format("{:.{}f} {}", nanoseconds, decimals, units[unit]);
}

std::string grouped(std::uint64_t number) {
  std::string digits = fmt::format("{}", number);
  for (std::size_t at = digits.size(); at > 3;) {
    at -= 3;
    digits.insert(at, "\u2009");
  }
  return digits;
}

}  // namespace triptych::report
