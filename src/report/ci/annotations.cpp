#include "report/ci/annotations.hpp"

#include <fmt/format.h>

#include <map>

#include "core/hash.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "core/quoting.hpp"
#include "report/finding_command.hpp"
#include "report/overview.hpp"
#include "report/words/cause.hpp"

namespace triptych::report {
namespace {

using judge::Finding;
using judge::Verdict;

constexpr std::size_t max_annotations_per_verdict = 10;

// Escapes a part of a workflow command, so that it cannot end the command or begin another one.
// `also` contains further characters to escape.
std::string escaped(std::string_view text, std::string_view also) {
  std::string result;
  for (const char c : text) {
    if (c == '%' || c == '\n' || c == '\r' || also.find(c) != std::string_view::npos) {
      result += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result;
}

std::string title_of(const Cause& cause) {
  return core::printable(
      fmt::format("{}: {}", judge::topic_of(*cause.group.first), words::location(cause)), 200);
}

std::string message_of(const Cause& cause) {
  const std::string command = command_of(*cause.group.first, *cause.result);
  return core::printable(words::text_of(cause)) +
         (command.empty() ? "" : "\n" + core::printable(command));
}

}  // namespace

std::string github_annotations(std::span<const judge::GateResult> results,
                               const FindingLocations& locations) {
  std::map<Verdict, std::size_t> written;
  std::string text;
  for (const Cause& cause : overview(results).open) {
    const Finding& first = *cause.group.first;
    if (++written[first.verdict] > max_annotations_per_verdict) continue;
    const SourceLocation location = locations.of(first, *cause.result);
    std::string where;
    if (!location.file.empty()) {
      where = fmt::format("file={},line={},", escaped(location.file, ",:"), location.line);
    }
    text += fmt::format("::{} {}title={}::{}\n",
                        first.verdict == Verdict::regression ? "error" : "warning", where,
                        escaped(title_of(cause), ",:"), escaped(message_of(cause), ""));
  }
  return text;
}

std::string gitlab_code_quality(std::span<const judge::GateResult> results,
                                const FindingLocations& locations) {
  core::Json issues = core::Json::array();
  for (const Cause& cause : overview(results).open) {
    const Finding& first = *cause.group.first;
    const SourceLocation location = locations.of(first, *cause.result);
    issues.push_back(
        {{"description", title_of(cause) + ": " + message_of(cause)},
         {"check_name", judge::topic_of(first)},
         {"fingerprint", core::content_hash(fmt::format("{}\n{}\n{}", first.test,
                                                        first.configuration, cause.group.kind))},
         {"severity", first.verdict == Verdict::regression ? "major" : "minor"},
         // GitLab ignores an issue without a path.
         {"location",
          {{"path", location.file.empty() ? cause.result->plan : location.file},
           {"lines", {{"begin", location.line}}}}}});
  }
  return core::json_text(issues, 2) + "\n";
}

}  // namespace triptych::report
