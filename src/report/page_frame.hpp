#pragma once
// What every page begins and ends with.

#include <string>
#include <string_view>

namespace triptych::report {

// From the doctype to the end of the header: styles and the figures' library are inside, so that
// the page needs no network. All three are text, not HTML.
[[nodiscard]] std::string page_begin(std::string_view title, std::string_view heading,
                                     std::string_view lead);
[[nodiscard]] std::string page_end();

// A figure: Vega-Lite specification (JSON text) drawn into an element of that id.
[[nodiscard]] std::string chart(std::string_view id, std::string_view specification);

}  // namespace triptych::report
