#pragma once
// Texts, marks and strokes of figures as SVG elements. Positions are in pixels.

#include <string>
#include <string_view>

#include "report/figures/figure.hpp"
#include "report/html.hpp"

namespace triptych::report {

// The width of a text in the size of the style sheet, from the mean width of its letters.
[[nodiscard]] double width_of(std::string_view text);

// The largest number of characters of a name next to an axis, and of a name in a legend. A long
// name in a legend gets a separate line.
inline constexpr std::size_t longest_name = 34;
inline constexpr std::size_t longest_entry = 64;

// A name with more characters is shortened in the middle, which is its least important part.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t longest = longest_name);

// The text that is shown when the pointer is over the element; nothing if it is empty.
[[nodiscard]] Html title_element(std::string_view text);

// `more`: further attributes, each with a space before it.
[[nodiscard]] Html text_element(double x, double y, std::string_view anchor, std::string_view text,
                                const Html& more = {});

[[nodiscard]] Html mark_element(double x, double y, const Style& style, std::string_view tooltip);

[[nodiscard]] Html line_attributes(const Style& style);

}  // namespace triptych::report
