#pragma once
#include <span>
#include <string>
#include <string_view>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// Text for Markdown as GitHub and GitLab read it, in one line: nothing in it is markup, HTML or a
// control character. At most so many characters.
[[nodiscard]] std::string markdown_escaped(std::string_view text, std::size_t limit = 500);

// A command as a block of code that nothing in it can end.
[[nodiscard]] std::string fenced(std::string_view command, std::string_view indent);

// A summary for a pull request: the rows and causes of the last screen, the worst openly, the rest
// and advice folded. Under 65,000 characters whatever was found.
[[nodiscard]] std::string markdown(std::span<const judge::GateResult> results);
[[nodiscard]] std::string markdown(const judge::GateResult& result);

}  // namespace triptych::report
