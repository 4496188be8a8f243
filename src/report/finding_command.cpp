#include "report/finding_command.hpp"

#include "record/factor_list.hpp"
#include "report/command.hpp"
#include "report/finding_groups.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using judge::Finding;
using judge::Verdict;

// Creates a command that measures and judges again, with a separate store. A difference from stored
// values cannot be reproduced in any other way.
void make_gate_command(const Finding& finding, const judge::GateResult& result, Command& command) {
  command.command = "gate";
  command.object = result.argument.empty() ? result.plan : result.argument;
  if (finding.check == Check::correlation) {
    // The check `correlation` fits a line to all configurations of several devices, so the command
    // measures all of them.
    command.device.clear();
    command.factors.clear();
  } else {
    command.factors.insert(result.defaults.begin(), result.defaults.end());
  }
  // The order of convergence is fitted to errors at several step sizes, so all of them are
  // measured.
  if (finding.check == Check::accuracy) command.factors.erase("step");
  command.more = {"--measure", "--check", std::string(judge::name_of(finding.check)), "--store",
                  "repro.sqlite"};
  if (finding.check == Check::timing && result.times_decided) {
    command.more.emplace_back("--times");
  }
  if (!result.baselines.empty()) {
    command.more.insert(command.more.end(), {"--baselines", result.baselines});
  }
}

// Creates a command that prints the stored statistics next to the statistics of the compiled code,
// because nothing is drawn for the check `code`.
void make_code_command(const judge::GateResult& result, Command& command) {
  command.command = "code";
  command.more = {"--brief"};
  if (result.plan != command.object + "/code") {
    command.more.insert(command.more.end(), {"--stored", result.plan});
  }
  if (!result.baselines.empty()) {
    command.more.insert(command.more.end(), {"--baselines", result.baselines});
  }
}

// Returns whether a command can name the plan. A plan from a file is named by its path, which a
// store does not contain.
bool can_name_plan(const judge::GateResult& result) {
  return !result.argument.empty() || result.plan.find('/') != std::string::npos;
}

}  // namespace

bool is_reproduced_by_render(const Finding& finding) {
  if (finding.device.empty() || finding.configuration.empty()) return false;
  return finding.check == Check::image || finding.check == Check::stress ||
         (finding.check != Check::code && finding.reason.limit());
}

std::string command_of(const Finding& finding, const judge::GateResult& result) {
  // There is no command for a skipped configuration, because it would only be skipped again.
  if (finding.device.empty() || finding.verdict == Verdict::skipped) return {};
  if (record::lacks_data(finding.outcome, finding.reason)) return {};
  if (finding.configuration.empty() && finding.check != Check::correlation) return {};
  Command command{.command = "render",
                  .object = finding.test.substr(0, finding.test.find('.')),
                  .device = finding.device,
                  .factors = record::parse_factor_list(finding.configuration),
                  .injected = finding.injected,
                  .limit = finding.reason.limit(),
                  .more = {"--truth", "--out", "repro"}};
  if (const auto set = result.environments.find(finding.device); set != result.environments.end()) {
    command.environment = allowed_environment(set->second);
  }
  if (finding.check == Check::code) {
    make_code_command(result, command);
    return text_of(command);
  }
  // --limit does not apply, because counting instructions has its own time limit.
  if (finding.check == Check::cost) command.limit.reset();
  if (!is_reproduced_by_render(finding)) {
    if (!is_open(finding) || !can_name_plan(result)) return {};
    make_gate_command(finding, result, command);
  }
  return text_of(command);
}

}  // namespace triptych::report
