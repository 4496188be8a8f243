#pragma once
#include <span>
#include <string>
#include <string_view>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// Escapes text for GitHub and GitLab Markdown and puts it on one line, so that nothing in it is
// interpreted as markup, HTML or a control character. The text is shortened to `limit` characters
// before it is escaped.
[[nodiscard]] std::string markdown_escaped(std::string_view text, std::size_t limit = 500);

// Returns a code block with a command. No characters in the command can close the block.
[[nodiscard]] std::string fenced(std::string_view command, std::string_view indent);

// Returns a summary for a pull request. It has the same rows and causes as the end of the terminal
// output (screen/summary_screen.hpp). The worst causes are visible, and all others are folded. The
// summary always has fewer than 65,000 characters.
[[nodiscard]] std::string markdown(std::span<const judge::GateResult> results);
[[nodiscard]] std::string markdown(const judge::GateResult& result);

}  // namespace triptych::report
