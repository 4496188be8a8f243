// The program `triptych`, which contains all commands. All errors except those in a worker are
// caught here. They are reported as one line on stderr and an exit code.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/arguments.hpp"
#include "app/terminal.hpp"
#include "app/version.hpp"
#include "core/foreign_error.hpp"
#include "measure/plan/plan_values.hpp"
#include "record/reason.hpp"
#include "report/words/outcome.hpp"

namespace triptych {
namespace {

using core::ExitCode;

constexpr const char* footer =
    "Exit codes: 0 pass, 1 regression, 2 could not judge, 3 usage or I/O error, 77 skipped.\n"
    "PLAN is a YAML file or a short name such as volume/quick. `triptych list PLAN` prints its "
    "configurations.";

// Reports an unknown command by name. CLI11 would report only that a command is required.
void refuse_unknown_command(const CLI::App& program, std::string_view name) {
  if (name.starts_with('-')) return;
  std::vector<std::string> known;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == name) return;
    if (!command->get_group().empty()) known.push_back(command->get_name());
  }
  throw core::InputError(
      fmt::format("unknown command '{}'{}", name, measure::suggestion(name, known)));
}

// Limits each option to one value per occurrence, even if the option may be repeated. Otherwise
// `run --device GLOB PLAN` would be parsed as two devices and no plan.
void give_options_one_value(CLI::App& program) {
  for (CLI::App* command : program.get_subcommands({})) {
    for (CLI::Option* option : command->get_options()) {
      if (!option->get_positional()) option->allow_extra_args(false);
    }
  }
}

ExitCode run(int argc, char** argv) {
  CLI::App program{
      "Cross-API portability tests: draws the same scenes with OpenCL, Vulkan and OpenGL, compares "
      "the images with a reference renderer, and compares the amount of work and its cost with "
      "stored baselines",
      "triptych"};
  program.set_version_flag("--version", "triptych " + app::version());
  program.require_subcommand(1);
  program.footer(footer);
  app::Commands commands{.program = program, .chosen = {}};
  for (const auto add :
       {app::add_devices_command, app::add_list_command, app::add_run_commands,
        app::add_render_command, app::add_view_command, app::add_code_command,
        app::add_reduce_command, app::add_gate_commands, app::add_compare_commands,
        app::add_report_command, app::add_merge_command, app::add_history_command,
        app::add_validate_command, app::add_features_command, app::add_export_command,
        app::add_test_commands, app::add_document_commands}) {
    add(commands);
  }
  give_options_one_value(program);
  if (argc > 1) refuse_unknown_command(program, argv[1]);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      program.exit(error);
      return ExitCode::pass;
    }
    app::print_err("triptych: {}\nRun with --help for more information.\n", error.what());
    // An older commit may lack some of the options on the command line. `git bisect` must skip such
    // a commit, because the resulting error is not a verdict on the commit.
    const auto arguments = std::span(argv, static_cast<std::size_t>(argc));
    const bool bisects =
        std::ranges::find(arguments, std::string_view("--bisect")) != arguments.end();
    return bisects ? app::bisect_skip_code : ExitCode::usage;
  }
  return commands.chosen();
}

ExitCode run_and_catch(int argc, char** argv) {
  try {
    return core::with_error_context({}, [&] { return run(argc, argv); });
  } catch (const record::NotMeasured& error) {
    app::print_err("triptych: {}\n", report::words::text_of(error.outcome(), error.reason()));
    return error.exit_code();
  } catch (const core::NotSupported& error) {
    app::print_err("triptych: {}\n", error.what());
    return ExitCode::cannot_judge;
  } catch (const std::exception& error) {
    app::print_err("triptych: {}\n", error.what());
    return ExitCode::usage;
  }
}

// Flushes standard output, because the end of the output may still be buffered. Returns false on
// failure, so that lost output does not look like success.
bool output_is_written() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  std::perror("triptych: cannot write to standard output");
  return false;
}

}  // namespace
}  // namespace triptych

int main(int argc, char** argv) {
  const auto code = triptych::run_and_catch(argc, argv);
  return static_cast<int>(triptych::output_is_written() ? code : triptych::ExitCode::usage);
}
