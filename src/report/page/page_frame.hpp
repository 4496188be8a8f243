#pragma once
// The beginning and the end of every page, and parts that can be folded.

#include <string_view>

#include "report/html.hpp"

namespace triptych::report {

// Everything from the doctype to the body. The style sheet is inside and figures are SVG, so that
// the page needs no network. Without its script, it shows everything except images that are
// repeated. Its Content-Security-Policy allows only that script, by its hash, and nothing from
// anywhere else.
[[nodiscard]] Html page_begin(std::string_view title);
[[nodiscard]] Html page_end();

// Empty if the body is empty.
[[nodiscard]] Html folded(const Content& summary, const Html& body);

}  // namespace triptych::report
