#include "report/ci/folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/file.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "core/quoting.hpp"
#include "record/short_name.hpp"
#include "report/ci/junit.hpp"
#include "report/ci/markdown.hpp"
#include "report/exports/verdict_json.hpp"
#include "report/finding_command.hpp"
#include "report/finding_groups.hpp"
#include "report/overview.hpp"
#include "report/words/cause.hpp"
#include "report/words/command_note.hpp"
#include "report/words/finding.hpp"

namespace triptych::report {
namespace {

// Returns further lines about a group that needs attention: whether the driver is at fault; what to
// do; its configurations, if there are several; the key of the first one, which for example `accept
// --only` needs; and the command that reproduces it.
std::string details_of(const FindingGroup& group, const judge::GateResult& result) {
  if (!is_open(*group.first)) return {};
  std::vector<std::string> lines{words::attribution(group), words::advice(*group.first)};
  if (group.members.size() > 1) {
    for (const judge::Finding* each : group.members) {
      const std::string name = record::short_name(each->configuration);
      lines.push_back(group.devices.size() > 1 ? fmt::format("{} {}", each->device, name) : name);
    }
  }
  if (const std::string& key = group.first->configuration; !key.empty()) {
    lines.push_back(fmt::format("key of {}: {}", record::short_name(key), key));
  }
  lines.push_back(command_of(*group.first, result));
  lines.push_back(words::command_note(*group.first, result));
  std::string text;
  for (const std::string& line : lines) {
    if (!line.empty()) text += fmt::format("{:13}{}\n", "", core::printable(line));
  }
  return text;
}

// Returns all findings that do not pass, grouped by cause, followed by the number of findings with
// each verdict and a one-line summary.
std::string log_of(const judge::GateResult& result) {
  std::string text;
  for (const FindingGroup& group : grouped(result.findings)) {
    const judge::Finding& finding = *group.first;
    if (finding.verdict == judge::Verdict::pass) continue;
    const std::string subject = words::subject(group);
    text += fmt::format("{:<12} {}{}{}: {}\n", judge::name_of(finding.verdict),
                        core::printable(finding.test), subject.empty() ? "" : " ",
                        core::printable(subject), core::printable(words::text_of(finding)));
    text += details_of(group, result);
  }
  std::map<judge::Verdict, int> counts;
  for (const judge::Finding& finding : result.findings) ++counts[finding.verdict];
  for (const auto& [verdict, count] : counts) {
    text += fmt::format("{} {}  ", count, judge::name_of(verdict));
  }
  return text + fmt::format("\n{}\n", words::headline(result));
}

// Returns a line for each device with its driver version, and a line for each circumstance.
std::string drivers_of(std::span<const judge::GateResult> results) {
  const Overview all = overview(results);
  std::map<std::string, std::string> by_device;
  for (const TestedDriver& driver : all.drivers) {
    for (const std::string& device : driver.devices) by_device[device] = driver.driver;
  }
  std::string text;
  for (const auto& [device, driver] : by_device) {
    text +=
        fmt::format("{:<12} {}: {}\n", "driver", core::printable(device), core::printable(driver));
  }
  for (const std::string& each : all.circumstances) {
    text += fmt::format("{:<12} {}\n", "note", core::printable(each));
  }
  return text;
}

}  // namespace

std::vector<std::string> write_folder(const std::filesystem::path& folder,
                                      std::span<const judge::GateResult> results,
                                      const FolderTexts& texts) {
  std::string log = drivers_of(results);
  for (const judge::GateResult& result : results) {
    log += log_of(result);
    std::string name = result.plan + ".xml";
    std::ranges::replace(name, '/', '-');
    core::write_file(junit(result, texts.junit), folder / name);
  }
  core::write_file(log, folder / "gate.log");
  core::write_file(markdown(results), folder / "summary.md");
  core::write_file(texts.page, folder / "report.html");
  core::write_file(texts.benchmark, folder / "benchmark.json");
  if (!texts.code_quality.empty()) {
    core::write_file(texts.code_quality, folder / "codequality.json");
  }
  return {(folder / "report.html").string(), (folder / "gate.log").string(),
          (folder / "summary.md").string()};
}

std::string json(std::span<const judge::GateResult> results) {
  core::Json json = core::Json::array();
  for (const judge::GateResult& result : results) json.push_back(to_json(result));
  return core::json_text(results.size() == 1 ? json.front() : json, 2) + "\n";
}

}  // namespace triptych::report
