#pragma once
#include <span>
#include <string>
#include <string_view>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// Escapes a text for the Markdown of GitHub and GitLab and puts it on one line, so that nothing in
// it is taken for markup, HTML or a control character. The result has at most `limit` characters.
[[nodiscard]] std::string markdown_escaped(std::string_view text, std::size_t limit = 500);

// A command as a code block that no text within the command can close.
[[nodiscard]] std::string fenced(std::string_view command, std::string_view indent);

// A summary for a pull request, with the rows and causes of the last screen: the worst are visible,
// the rest and the advice are folded. It has fewer than 65,000 characters, whatever was found.
[[nodiscard]] std::string markdown(std::span<const judge::GateResult> results);
[[nodiscard]] std::string markdown(const judge::GateResult& result);

}  // namespace triptych::report
