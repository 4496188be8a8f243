#include "report/ci/junit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "record/short_name.hpp"
#include "report/finding_command.hpp"
#include "report/finding_groups.hpp"
#include "report/html.hpp"
#include "report/words/command_note.hpp"
#include "report/words/finding.hpp"

namespace triptych::report {
namespace {

using judge::Finding;
using judge::Verdict;

bool is_skip(const Finding& finding) {
  return finding.verdict == Verdict::skipped || finding.verdict == Verdict::advisory;
}

// Returns the cause and all numbers as properties, so that programs do not have to parse the
// message.
std::string properties(const Finding& finding) {
  std::string text;
  const auto add = [&](std::string_view name, std::string_view value) {
    text +=
        fmt::format("        <property name=\"{}\" value=\"{}\"/>\n", escape(name), escape(value));
  };
  if (!finding.configuration.empty()) add("configuration", finding.configuration);
  add("cause", judge::name_of(finding.cause));
  if (finding.against != judge::Against::nothing) {
    add("against", judge::name_of(finding.against));
  }
  if (finding.advice.advice != judge::Advice::none) {
    add("advice", judge::name_of(finding.advice.advice));
  }
  if (finding.reason.cause != record::Cause::none) {
    add("outcome", record::name_of(finding.outcome));
    add("outcome_cause", record::name_of(finding.reason.cause));
    for (const auto& [name, value] : finding.reason.numbers) add(name, fmt::to_string(value));
  }
  for (const auto& [name, value] : finding.numbers) add(name, fmt::to_string(value));
  for (const judge::Change& each : finding.changes) {
    if (each.before) add(each.name + ".before", fmt::to_string(*each.before));
    if (each.now) add(each.name + ".now", fmt::to_string(*each.now));
  }
  return "      <properties>\n" + text + "      </properties>\n";
}

std::string name_of(const Finding& finding) {
  if (finding.configuration.empty()) return "plan";
  const std::string name = record::short_name(finding.configuration);
  return name.empty() ? finding.configuration : name;
}

// Writes one JUnit document. Remembers the configurations whose time was already written.
class Junit {
 public:
  explicit Junit(const JunitFacts& facts) : facts_(facts) {}
  std::string test_suites(const judge::GateResult& result);

 private:
  std::string test_case(const Finding& finding, const judge::GateResult& result);
  double take_seconds(const Finding& finding, const judge::GateResult& result);

  const JunitFacts& facts_;
  std::set<std::string> timed_;
};

double Junit::take_seconds(const Finding& finding, const judge::GateResult& result) {
  const auto plan = facts_.seconds.find(result.plan);
  if (plan == facts_.seconds.end()) return 0;
  const auto found = plan->second.find({finding.device, finding.configuration});
  const std::string key = result.plan + '\n' + finding.device + '\n' + finding.configuration;
  return found != plan->second.end() && timed_.insert(key).second ? found->second : 0;
}

std::string Junit::test_case(const Finding& finding, const judge::GateResult& result) {
  std::string text =
      fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"",
                  escape(finding.test), escape(name_of(finding)), take_seconds(finding, result));
  const SourceLocation location =
      facts_.locations == nullptr ? SourceLocation{} : facts_.locations->of(finding, result);
  if (!location.file.empty()) {
    text += fmt::format(" file=\"{}\" line=\"{}\"", escape(location.file), location.line);
  }
  text += ">\n";
  text += properties(finding);
  const std::string message = escape(words::text_of(finding));
  if (is_open(finding)) {
    std::string command = escape(command_of(finding, result));
    if (const std::string note = words::command_note(finding, result); !note.empty()) {
      command += "\n" + escape(note);
    }
    text += fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{2}{3}{4}</{0}>\n",
                        finding.verdict == Verdict::regression ? "failure" : "error",
                        judge::topic_of(finding), message, command.empty() ? "" : "\n", command);
  } else if (is_skip(finding)) {
    text += fmt::format("      <skipped message=\"{}\"/>\n", message);
  }
  return text + "    </testcase>\n";
}

std::string Junit::test_suites(const judge::GateResult& result) {
  std::map<std::string, std::vector<const Finding*>> suites;
  for (const Finding& finding : result.findings) {
    suites[std::string(judge::topic_of(finding))].push_back(&finding);
  }
  std::string text;
  for (const auto& [check, findings] : suites) {
    const auto count = [&](auto&& matches) { return std::ranges::count_if(findings, matches); };
    text += fmt::format(
        "  <testsuite name=\"{}.{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n",
        escape(result.plan), check, findings.size(),
        count([](const Finding* f) { return f->verdict == Verdict::regression; }),
        count([](const Finding* f) { return f->verdict == Verdict::cannot_judge; }),
        count([](const Finding* f) { return is_skip(*f); }));
    for (const Finding* finding : findings) text += test_case(*finding, result);
    text += "  </testsuite>\n";
  }
  return text;
}

}  // namespace

std::string junit(std::span<const judge::GateResult> results, const JunitFacts& facts) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  Junit document(facts);
  for (const judge::GateResult& result : results) text += document.test_suites(result);
  return text + "</testsuites>\n";
}

std::string junit(const judge::GateResult& result, const JunitFacts& facts) {
  return junit(std::span(&result, 1), facts);
}

}  // namespace triptych::report
