#include "report/ci/markdown.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "core/quoting.hpp"
#include "report/finding_command.hpp"
#include "report/overview.hpp"
#include "report/words/cause.hpp"
#include "report/words/command_note.hpp"

namespace triptych::report {
namespace {

constexpr std::size_t max_visible_causes = 10;
constexpr std::size_t max_characters = 60000;
constexpr std::size_t max_listed_command = 4000;
constexpr std::size_t max_bounds_length = 8000;
constexpr std::size_t max_drivers_length = 4000;

std::string rows(const Overview& all) {
  std::string text = "| check | verdict | details |\n|---|---|---|\n";
  for (const CheckRow& row : all.rows) {
    text += fmt::format("| {} | {} | {} |\n", row.label,
                        row.worst == judge::Verdict::regression ? "**FAIL**" : row.verdict,
                        markdown_escaped(row.sentence));
  }
  return text;
}

// Lists the driver versions that were tested, in one paragraph.
std::string drivers(const Overview& all) {
  if (all.drivers.empty()) return {};
  std::string text;
  for (const TestedDriver& each : all.drivers) {
    text += fmt::format("{}{}: {}", text.empty() ? "Drivers: " : "; ", each.driver,
                        fmt::join(each.devices, ", "));
    if (text.size() > max_drivers_length) break;
  }
  return markdown_escaped(text, 2 * max_drivers_length) + "\n\n";
}

std::string item(const Cause& cause) {
  const judge::Finding& first = *cause.group.first;
  std::string text = fmt::format("- **{}** {}: {}  \n  {}\n", judge::name_of(first.verdict),
                                 judge::topic_of(first), markdown_escaped(words::location(cause)),
                                 markdown_escaped(words::text_of(cause)));
  const std::string command = command_of(first, *cause.result);
  if (command.empty() || command.size() >= max_listed_command) return text;
  text += fenced(command, "  ");
  if (const std::string note = words::command_note(first, *cause.result); !note.empty()) {
    text += fmt::format("  {}\n", markdown_escaped(note));
  }
  return text;
}

std::string bounds_details(const Overview& all) {
  if (all.bounds.empty()) return {};
  std::string text =
      "\n<details><summary>How close images come to their bounds</summary>\n\n"
      "| plan | device | images | largest error / bound | configuration |\n|---|---|--:|--:|---|\n";
  for (const NearestBound& bound : all.bounds) {
    text += fmt::format("| {} | {} | {} | {:.3g} | {} |\n", markdown_escaped(bound.plan),
                        markdown_escaped(bound.device), bound.images, bound.share,
                        markdown_escaped(bound.configuration));
    if (text.size() > max_bounds_length) break;
  }
  return text + "\n</details>\n";
}

// Returns only the number of advisories and skips, because listing them in the summary would bury
// new findings. They are listed on the page.
std::string counted(const std::map<std::string_view, std::size_t>& remark_counts) {
  if (remark_counts.empty()) return {};
  std::size_t all = 0;
  std::string checks;
  for (const auto& [check, count] : remark_counts) {
    all += count;
    checks += fmt::format("{}{} {}", checks.empty() ? "" : ", ", check, count);
  }
  return fmt::format("\nreport.html also contains {} remark{} that {} not affect the verdict: {}\n",
                     all, all == 1 ? "" : "s", all == 1 ? "does" : "do", checks);
}

}  // namespace

std::string fenced(std::string_view command, std::string_view indent) {
  std::string fence = "```";
  while (command.find(fence) != std::string_view::npos) fence += '`';
  return fmt::format("\n{2}{0}sh\n{2}{1}\n{2}{0}\n", fence, command, indent);
}

std::string markdown_escaped(std::string_view text, std::size_t limit) {
  std::string result;
  for (const char c : core::printable(text, limit)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '@':  // a name after '@' would notify that user
        result += "@\u200B";
        break;
      default:
        if (std::string_view("\\`*_{}[]()#!|~").find(c) != std::string_view::npos) result += '\\';
        result += c;
    }
  }
  return result;
}

std::string markdown(std::span<const judge::GateResult> results) {
  const Overview all = overview(results);
  std::string text =
      fmt::format("## {} ({})", words::verdict_word(all.code), static_cast<int>(all.code));
  for (const judge::GateResult& result : results) {
    text +=
        fmt::format("{} {}", &result == results.data() ? ":" : ",", markdown_escaped(result.plan));
  }
  text +=
      fmt::format("{}\n\n{}\n", all.part ? " (only part of the plans was judged)" : "", rows(all));
  for (const std::string& each : all.circumstances)
    text += "- **" + markdown_escaped(each) + "**\n";
  if (!all.circumstances.empty()) text += '\n';
  text += drivers(all);
  if (all.code == core::ExitCode::pass && !all.undecided.empty()) {
    text += fmt::format("{}\n\n", markdown_escaped(words::pass_text(all)));
  }
  std::vector<const Cause*> rest;
  for (std::size_t i = 0; i < all.open.size(); ++i) {
    if (i < max_visible_causes) {
      text += item(all.open[i]);
    } else {
      rest.push_back(&all.open[i]);
    }
  }
  std::map<std::string_view, std::size_t> remark_counts;  // number of remarks by check
  for (const Cause& cause : all.remarks) {
    const judge::Verdict verdict = cause.group.first->verdict;
    if (verdict == judge::Verdict::waived || verdict == judge::Verdict::improved) {
      rest.push_back(&cause);
    } else {
      ++remark_counts[judge::topic_of(*cause.group.first)];
    }
  }
  text += bounds_details(all) + counted(remark_counts);
  if (rest.empty()) return text;
  text += fmt::format("\n<details><summary>{} more</summary>\n\n", rest.size());
  for (const Cause* cause : rest) {
    const std::string next = item(*cause);
    if (text.size() + next.size() > max_characters) {
      text += "- …\n";
      break;
    }
    text += next;
  }
  return text + "\n</details>\n";
}

std::string markdown(const judge::GateResult& result) {
  return markdown(std::span(&result, 1));
}

}  // namespace triptych::report
