#include "report/markdown.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/finding_groups.hpp"

namespace triptych::report {
namespace {

constexpr std::size_t shown_openly = 10;

// Pipes and line ends would break a table's row.
std::string cell(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) {
    text.replace(at, 1, "\\|");
  }
  return text;
}

std::string table(std::span<const FindingGroup> groups) {
  std::string text = "| verdict | test | configuration | message |\n|---|---|---|---|\n";
  for (const FindingGroup& group : groups) {
    const judge::Finding& finding = *group.first;
    text += fmt::format("| {} | `{}` | {} | {} |\n", judge::name_of(finding.verdict), finding.test,
                        cell(group.subject()), cell(finding.message));
  }
  return text;
}

}  // namespace

std::string markdown(const judge::GateResult& result) {
  std::string text = fmt::format("## {}: {}\n\n", result.plan, result.headline());
  const std::vector<FindingGroup> groups = grouped(result.findings);
  const std::span<const FindingGroup> all(groups);
  const std::span<const FindingGroup> worst = all.first(std::min(shown_openly, all.size()));
  if (!worst.empty()) text += table(worst);
  if (all.size() > worst.size()) {
    text += fmt::format("\n<details><summary>{} more</summary>\n\n{}\n</details>\n",
                        all.size() - worst.size(), table(all.subspan(worst.size())));
  }
  return text;
}

}  // namespace triptych::report
