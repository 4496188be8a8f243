#pragma once
// What every page begins and ends with, and what folds away.

#include <string>
#include <string_view>

namespace triptych::report {

// From the doctype to the body: the style sheet is inside and figures are SVG, so that the page
// needs no network, and tells everything but pictures that repeat without its script. `title` is
// text, not HTML.
[[nodiscard]] std::string page_begin(std::string_view title);
[[nodiscard]] std::string page_end(std::string_view script = {});

// `summary` and `body` are HTML; empty where the body is.
[[nodiscard]] std::string folded(std::string_view summary, const std::string& body);

}  // namespace triptych::report
