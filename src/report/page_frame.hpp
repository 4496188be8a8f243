#pragma once
// What every page begins and ends with, and what folds away.

#include <string_view>

#include "report/html.hpp"

namespace triptych::report {

// From the doctype to the body: the style sheet is inside and figures are SVG, so that the page
// needs no network, and tells everything but pictures that repeat without its script. Its
// Content-Security-Policy allows that script alone, by its hash, and nothing from anywhere else.
[[nodiscard]] Html page_begin(std::string_view title);
[[nodiscard]] Html page_end(bool with_script = false);

// Empty where the body is.
[[nodiscard]] Html folded(const Content& summary, const Html& body);

}  // namespace triptych::report
