#pragma once
// The beginning and the end of every HTML page, and sections that can be folded.

#include <string_view>

#include "report/html.hpp"

namespace triptych::report {

// Returns everything from the doctype to the beginning of the body. The page contains its style
// sheet, and figures are SVG, so it works without a network. If scripts are disabled, it shows
// everything except repeated images. Its Content-Security-Policy allows only the script in the
// page, which is identified by its hash, and no external content.
[[nodiscard]] Html page_begin(std::string_view title);
[[nodiscard]] Html page_end();

// Returns a section that is folded at first, or nothing if `body` is empty.
[[nodiscard]] Html folded(const Content& summary, const Html& body);

}  // namespace triptych::report
