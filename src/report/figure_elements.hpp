#pragma once
// Texts, marks and strokes of figures as SVG elements; places in pixels.

#include <string>
#include <string_view>

#include "report/html.hpp"
#include "report/figure.hpp"

namespace triptych::report {

// Of a text of the style sheet's size, by the mean advance of its letters.
[[nodiscard]] double width_of(std::string_view text);

// Characters of a name beside an axis, and of one in a legend, which has a line of its own where it
// needs it.
inline constexpr std::size_t longest_name = 34;
inline constexpr std::size_t longest_entry = 64;

// A name of more characters than that without its middle, which says least.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t longest = longest_name);

// What a pointer over the element shows; nothing for no text.
[[nodiscard]] Html title_element(std::string_view text);

// `more`: further attributes, each with a blank before it.
[[nodiscard]] Html text_element(double x, double y, std::string_view anchor,
                                       std::string_view text, const Html& more = {});

[[nodiscard]] Html mark_element(double x, double y, const Style& style,
                                       std::string_view tooltip);

[[nodiscard]] Html line_attributes(const Style& style);

}  // namespace triptych::report
