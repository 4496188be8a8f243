#pragma once
// Functions that generate the HTML of the pages. Markup has its own type, Html, which can be
// created only from format strings in this program and from escaped text. So a name from a store
// cannot inject an element, even if somebody forgets to escape it.

#include <fmt/format.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace triptych::report {

// Escapes text for HTML and XML, both in elements and in attributes. Hidden characters
// (core/text.hpp), except line breaks and tabs, become visible escape sequences, and malformed
// characters become U+FFFD.
[[nodiscard]] std::string escape(std::string_view text);

class Html;

// Converts an argument of markup(): escapes text, but returns markup and numbers unchanged.
template <typename Arg>
auto as_markup(const Arg& arg) {
  if constexpr (std::same_as<Arg, Html>) {
    return std::string_view(arg.text());
  } else if constexpr (std::convertible_to<const Arg&, std::string_view>) {
    return escape(arg);
  } else {
    static_assert(std::is_arithmetic_v<Arg>, "join markup with +=, and pass text as an argument");
    return arg;
  }
}
template <typename... Args>
using MarkupFormat = fmt::format_string<decltype(as_markup(std::declval<const Args&>()))...>;

// Markup that can be put on a page without escaping.
class Html {
 public:
  Html() = default;

  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  [[nodiscard]] bool empty() const noexcept { return text_.empty(); }
  Html& operator+=(const Html& more) {
    text_ += more.text_;
    return *this;
  }
  friend Html operator+(Html left, const Html& right) { return std::move(left += right); }

 private:
  explicit Html(std::string text) : text_(std::move(text)) {}
  std::string text_;

  template <typename... Args>
  friend Html markup(MarkupFormat<Args...> format, const Args&... args);
  friend Html embedded_markup(std::string_view file);
  friend Html data_uri(std::span<const std::byte> png);
  friend Html without_repeated_images(const Html& page);
};

// The only function that creates elements. The format string is a literal that contains markup;
// arguments that are text are escaped.
template <typename... Args>
Html markup(MarkupFormat<Args...> format, const Args&... args) {
  const auto all = std::make_tuple(as_markup(args)...);
  return Html(std::apply(
      [&](const auto&... each) {
        return fmt::vformat(fmt::string_view(format), fmt::make_format_args(each...));
      },
      all));
}

// The content of an element: markup, or text, which is escaped.
class Content {
 public:
  template <typename Text>
  requires std::convertible_to<const Text&, std::string_view> Content(const Text& text)  // NOLINT
      : html_(markup("{}", std::string_view(text))) {}
  Content(Html html) : html_(std::move(html)) {}  // NOLINT(google-explicit-constructor)
  [[nodiscard]] const Html& html() const noexcept { return html_; }

 private:
  Html html_;
};
using TableRow = std::vector<Content>;
using Rows = std::vector<TableRow>;

// Returns the text with a line-break opportunity after each of the characters ".:,=/".
[[nodiscard]] Html breakable(std::string_view text);

// Returns a "data:image/png;base64,…" URI.
[[nodiscard]] Html data_uri(std::span<const std::byte> png);

// Return the style sheet or the script that is built into the program, and its hash for a
// Content-Security-Policy: SHA-256 in base64.
[[nodiscard]] Html embedded_markup(std::string_view file);
[[nodiscard]] std::string embedded_sha256(std::string_view file);

// Returns the page with the bytes of each distinct image only once. A repeated image has the
// attribute `data-same` instead of `src`: the index of its first occurrence among all `img`
// elements.
[[nodiscard]] Html without_repeated_images(const Html& page);

// Returns a table. The first row is its header. Columns of quantities get the CSS class "number",
// which aligns them to the right.
[[nodiscard]] Html table(const Rows& rows, std::string_view css_class = {});

// Formats a duration with three significant digits: "12.3 ms", "850 µs".
[[nodiscard]] std::string duration(double nanoseconds);

// Groups the digits of a number with thin spaces: 1234567 → "1 234 567".
[[nodiscard]] std::string grouped(std::uint64_t number);

}  // namespace triptych::report
