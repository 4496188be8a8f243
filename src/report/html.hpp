#pragma once
// The little HTML that the pages need. Markup has a type of its own, which only a format of ours and
// text that is escaped can make: a name from a store cannot become an element, whoever forgets
// what about it.

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

// Text for HTML and XML, element content and attributes alike. Hidden characters (core/text.hpp)
// but line ends and tabs become their visible escapes, and what is malformed becomes U+FFFD.
[[nodiscard]] std::string escape(std::string_view text);

class Html;

// What markup() makes of an argument: text is escaped, markup and numbers stay.
template <typename Arg>
auto as_markup(const Arg& arg) {
  if constexpr (std::same_as<Arg, Html>) {
    return std::string_view(arg.text());
  } else if constexpr (std::convertible_to<const Arg&, std::string_view>) {
    return escape(arg);
  } else {
    static_assert(std::is_arithmetic_v<Arg>, "join markup by +=, and text before it is an argument");
    return arg;
  }
}
template <typename... Args>
using MarkupFormat = fmt::format_string<decltype(as_markup(std::declval<const Args&>()))...>;

// Markup that may stand on a page as it is.
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

// The one function that makes elements: the format is markup, a literal of the program; of the
// arguments what is text is escaped.
template <typename... Args>
Html markup(MarkupFormat<Args...> format, const Args&... args) {
  const auto all = std::make_tuple(as_markup(args)...);
  return Html(std::apply(
      [&](const auto&... each) {
        return fmt::vformat(fmt::string_view(format), fmt::make_format_args(each...));
      },
      all));
}

// Content of an element: text, which is escaped, or markup.
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

// Text which may be broken after what separates parts of a test's id or a configuration.
[[nodiscard]] Html breakable(std::string_view text);

// "data:image/png;base64,…"
[[nodiscard]] Html data_uri(std::span<const std::byte> png);

// The style sheet and the script that are built into the program, and what a
// Content-Security-Policy calls them: SHA-256 in base64.
[[nodiscard]] Html embedded_markup(std::string_view file);
[[nodiscard]] std::string embedded_sha256(std::string_view file);

// The page with each picture's bytes once: an image that repeats an earlier one has, in place of
// its `src`, `data-same` with the number of that image among all `img` elements.
[[nodiscard]] Html without_repeated_pictures(const Html& page);

// A table; the first row is its head. Columns of quantities are set flush right by the style
// sheet's class "number".
[[nodiscard]] Html table(const Rows& rows, std::string_view css_class = {});

// "12.3 ms", "850 µs": three significant digits.
[[nodiscard]] std::string duration(double nanoseconds);

// 1234567 → "1 234 567" with thin spaces.
[[nodiscard]] std::string grouped(std::uint64_t number);

}  // namespace triptych::report
