#pragma once
// The little HTML that the pages need.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::report {

// Text for HTML and XML, element content and attributes alike. Control characters are left out, and
// what is malformed becomes U+FFFD.
[[nodiscard]] std::string escape(std::string_view text);

// The same, which may be broken after what separates parts of a test's id or a configuration.
[[nodiscard]] std::string breakable(std::string_view text);

// "data:image/png;base64,…"
[[nodiscard]] std::string data_uri(std::span<const std::byte> png);

// The page with each picture's bytes once: an image that repeats an earlier one has, in place of
// its `src`, `data-same` with the number of that image among all `img` elements.
[[nodiscard]] std::string without_repeated_pictures(std::string_view page);

// A table from cells that are HTML already; the first row is its head. Columns of quantities
// are set flush right by the style sheet's class "number".
[[nodiscard]] std::string table(const std::vector<std::vector<std::string>>& rows,
                                std::string_view css_class = {});

// "12.3 ms", "850 µs": three significant digits.
[[nodiscard]] std::string duration(double nanoseconds);

// 1234567 → "1 234 567" with thin spaces.
[[nodiscard]] std::string grouped(std::uint64_t number);

}  // namespace triptych::report
