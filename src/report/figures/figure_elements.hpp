#pragma once
// SVG elements for the text, marks and lines of figures. Positions are in pixels.

#include <string>
#include <string_view>

#include "report/figures/figure.hpp"
#include "report/html.hpp"

namespace triptych::report {

// Estimates the width of text at the font size of the style sheet, using the mean width of a
// letter.
[[nodiscard]] double width_of(std::string_view text);

// The maximum number of characters in a name next to an axis (max_name_length) and in a legend
// (max_legend_length). The maximum for a legend is larger, because a long name gets its own line
// there.
inline constexpr std::size_t max_name_length = 34;
inline constexpr std::size_t max_legend_length = 64;

// Shortens text that is longer than `longest` characters. Removes the middle of the text, because
// it is the least important part of a name.
[[nodiscard]] std::string shortened(std::string_view text,
                                    std::size_t max_length = max_name_length);

// Returns a tooltip for the enclosing element, or nothing if `text` is empty.
[[nodiscard]] Html title_element(std::string_view text);

// Returns a text element. `more` contains further attributes, each preceded by a space.
[[nodiscard]] Html text_element(double x, double y, std::string_view anchor, std::string_view text,
                                const Html& more = {});

[[nodiscard]] Html mark_element(double x, double y, const Style& style, std::string_view tooltip);

[[nodiscard]] Html line_attributes(const Style& style);

}  // namespace triptych::report
