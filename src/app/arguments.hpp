#pragma once
// Command-line options shared by several commands.

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/json.hpp"
#include "measure/plan/plan_choice.hpp"
#include "record/reason.hpp"

namespace triptych::app {

// The command-line parser, and the action of the command that the user chose. Each command
// registers itself with add(). Its action `run` is called after parsing and returns the exit code.
struct Commands {
  CLI::App& program;
  std::function<core::ExitCode()> chosen;

  CLI::App& add(const std::string& name, const std::string& summary,
                std::function<core::ExitCode()> run);

  // A registered command, and the struct that receives its parsed options. The struct is passed to
  // `run`.
  template <typename Arguments>
  struct Added {
    CLI::App& command;
    Arguments& arguments;
  };
  template <typename Arguments>
  Added<Arguments> add(const std::string& name, const std::string& summary,
                       core::ExitCode (*run)(const Arguments&), Arguments defaults = {}) {
    auto storage = std::make_shared<Arguments>(std::move(defaults));
    return {add(name, summary, [run, storage] { return run(*storage); }), *storage};
  }
};

// Adds a complete example command line to --help and to the manual page, above the footer that all
// commands share.
void add_example(CLI::App& command, const std::string& example);

using measure::PlanChoice;
// Adds --set, --shard and all options of add_selection_options().
void add_choice_options(CLI::App& command, PlanChoice& choice);
// Adds --filter, --caselist and --fraction.
void add_selection_options(CLI::App& command, PlanChoice& choice);
// Returns the error to throw if the options in `choice` match no configuration of any plan.
[[nodiscard]] core::InputError nothing_selected(const PlanChoice& choice);

// Adds the positional argument PLAN. At least one plan is required.
template <typename Plans>
void add_plan_option(CLI::App& command, Plans& plans) {
  command.add_option("PLAN", plans, "A plan: a YAML file, or SUITE/PLAN such as volume/quick")
      ->required();
}

inline constexpr const char* default_store = "triptych.sqlite";

// `git bisect run` skips a commit if its command exits with this code.
inline constexpr auto bisect_skip_code = static_cast<core::ExitCode>(125);

// Adds --baselines. An empty name is rejected, because it would mean the current folder.
void add_baselines_option(
    CLI::App& command, std::string& folder,
    const std::string& help =
        "Read the baselines from this folder (default: ./baselines if it exists, else "
        "the installed baselines)");

// Adds --device for commands that read stored records. The option selects from the devices for
// which there are records.
void add_devices_option(CLI::App& command, std::vector<std::string>& globs);

// Adds --inject FAULT[@GLOB] (repeatable), and its former name --plant, which is hidden from
// --help.
void add_inject_option(CLI::App& command, std::vector<std::string>& faults,
                       const std::string& help);

// Adds --limit, the number of seconds after which `what` is treated as hung.
inline constexpr int default_limit_s = record::default_limit.count();
void add_limit_option(CLI::App& command, int& seconds, const std::string& what);

// Adds --without-data.
void add_without_data_option(CLI::App& command, bool& without);

// Adds --verbose.
void add_verbose_option(CLI::App& command, bool& verbose);

// Prints `json` to standard output.
void print(const core::Json& json, int indent = 2);

void add_devices_command(Commands& commands);
void add_list_command(Commands& commands);
void add_run_commands(Commands& commands);  // run and worker
void add_render_command(Commands& commands);
void add_view_command(Commands& commands);
void add_code_command(Commands& commands);
void add_reduce_command(Commands& commands);
void add_gate_commands(Commands& commands);     // gate and accept
void add_compare_commands(Commands& commands);  // compare and diff
void add_report_command(Commands& commands);
void add_merge_command(Commands& commands);
void add_history_command(Commands& commands);
void add_validate_command(Commands& commands);
void add_features_command(Commands& commands);
void add_export_command(Commands& commands);
void add_test_commands(Commands& commands);      // commands for CTest
void add_document_commands(Commands& commands);  // commands that only the build calls

}  // namespace triptych::app
