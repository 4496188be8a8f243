#pragma once
// The HTML that the pages need. Markup has its own type, which only a format in this program and
// escaped text can produce. So a name from a store cannot become an element, even if somebody
// forgets to escape it.

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

// Escapes text for HTML and XML, for the content of elements and for attributes. Hidden characters
// (core/text.hpp) except the ends of lines and tabs become visible escapes, and malformed
// characters become U+FFFD.
[[nodiscard]] std::string escape(std::string_view text);

class Html;

// How markup() treats an argument: text is escaped, markup and numbers are not changed.
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

// Markup that can be put on a page as it is.
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
  friend Html without_repeated_pictures(const Html& page);
};

// The only function that makes elements. The format is markup, a literal in the program; arguments
// that are text are escaped.
template <typename... Args>
Html markup(MarkupFormat<Args...> format, const Args&... args) {
  const auto all = std::make_tuple(as_markup(args)...);
  return Html(std::apply(
      [&](const auto&... each) {
        return fmt::vformat(fmt::string_view(format), fmt::make_format_args(each...));
      },
      all));
}

// The content of an element: text, which is escaped, or markup.
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

// A "data:image/png;base64,…" URI.
[[nodiscard]] Html breakable(std::string_view text);

// The style sheet and the script that are built into the program, and their hashes for a
// Content-Security-Policy: SHA-256 in base64.
[[nodiscard]] Html data_uri(std::span<const std::byte> png);

// The style sheet and the script that are built into the program, and their names in a
// Content-Security-Policy: SHA-256 in base64.
[[nodiscard]] Html embedded_markup(std::string_view file);
[[nodiscard]] std::string embedded_sha256(std::string_view file);

// The page, with the bytes of each image only once. An image that repeats an earlier one has no
// `src` but `data-same`, with the number of that image among all `img` elements.
[[nodiscard]] Html without_repeated_pictures(const Html& page);

// A table whose first row is its head. Columns of quantities get the class "number" of the style
// sheet, which aligns them to the right.
[[nodiscard]] Html table(const Rows& rows, std::string_view css_class = {});

// "12.3 ms", "850 µs": three significant digits.
[[nodiscard]] std::string duration(double nanoseconds);

// 1234567 → "1 234 567" with thin spaces.
[[nodiscard]] std::string grouped(std::uint64_t number);

}  // namespace triptych::report
