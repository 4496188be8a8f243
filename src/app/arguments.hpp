#pragma once
// What several commands take, spelled once.

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "measure/plan/plan.hpp"
#include "measure/run/runner.hpp"
#include "record/hung.hpp"

namespace triptych::app {

// A command adds itself to the program; what it does runs after parsing and returns the exit code.
struct Commands {
  CLI::App& program;
  std::function<core::ExitCode()> chosen;

  // Adds a command whose work is `run`.
  CLI::App* add(const std::string& name, const std::string& summary,
                std::function<core::ExitCode()> run);
};

// What is taken of a plan.
struct PlanChoice {
  std::vector<std::string> set;  // "factor=a,b"
  std::string shard;             // "i/n"

  void add_to(CLI::App& command);
  // Both throw core::InputError.
  [[nodiscard]] measure::Plan load(const std::string& plan,
                                   const measure::FindSuite& find_suite) const;
  [[nodiscard]] measure::Shard shard_chosen() const;
};

struct PlanArguments {
  std::string plan;
  PlanChoice choice;

  void add_to(CLI::App& command);
  [[nodiscard]] measure::Plan load(const measure::FindSuite& find_suite) const {
    return choice.load(plan, find_suite);
  }
};

// The folder of the baselines; one without a name would be the folder the program is started in.
void add_baselines_option(CLI::App& command, std::string& folder);

// --inject FAULT[@GLOB], repeatable, and its former name --plant, which help does not list.
void add_inject_option(CLI::App& command, std::vector<std::string>& faults,
                       const std::string& help);

// Seconds until `what` counts as hung.
inline constexpr int standard_limit_s = record::standard_limit.count();
void add_limit_option(CLI::App& command, int& seconds, const std::string& what);

// "factor=a,b" → {factor, {a, b}}, each value as record::escaped spells it or plainly; throws
// core::InputError.
[[nodiscard]] measure::Overrides parse_overrides(const std::vector<std::string>& set);

// "FAULT" or "FAULT@GLOB".
[[nodiscard]] std::vector<measure::InjectedFault> parse_faults(
    const std::vector<std::string>& faults);

void add_devices_command(Commands& commands);
void add_list_command(Commands& commands);
void add_run_commands(Commands& commands);  // run, worker
void add_render_command(Commands& commands);
void add_reduce_command(Commands& commands);
void add_gate_commands(Commands& commands);     // gate, accept
void add_compare_commands(Commands& commands);  // compare, diff
void add_report_command(Commands& commands);
void add_merge_command(Commands& commands);
void add_history_command(Commands& commands);
void add_validate_command(Commands& commands);
void add_export_command(Commands& commands);
void add_test_commands(Commands& commands);      // what CTest calls
void add_document_commands(Commands& commands);  // what the build calls

}  // namespace triptych::app
