// triptych: one program for everything. Errors are caught here and nowhere above the worker: one
// line on stderr and an exit code people expect.

#include <fmt/format.h>

#include <exception>

#include "app/arguments.hpp"

namespace {

using triptych::core::ExitCode;

constexpr const char* footer =
    "Exit codes: 0 pass, 1 regression, 2 could not judge, 3 usage or I/O, 77 skipped (tests).\n"
    "A PLAN is a YAML file or a short name such as volume/quick; `triptych list PLAN` shows it.";

ExitCode run(int argc, char** argv) {
  CLI::App program{
      "Cross-API portability tests: the same scenes through OpenCL, Vulkan and OpenGL, "
      "judged against the truth and against stored baselines",
      "triptych"};
  program.set_version_flag("--version", TRIPTYCH_VERSION);
  program.require_subcommand(1);
  program.footer(footer);
  triptych::app::Commands commands{.program = program, .chosen = {}};
  triptych::app::add_devices_command(commands);
  triptych::app::add_list_command(commands);
  triptych::app::add_run_commands(commands);
  triptych::app::add_render_command(commands);
  triptych::app::add_gate_commands(commands);
  triptych::app::add_compare_command(commands);
  triptych::app::add_evaluate_command(commands);
  triptych::app::add_report_command(commands);
  triptych::app::add_validate_command(commands);
  triptych::app::add_analyze_command(commands);
  triptych::app::add_test_commands(commands);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? ExitCode::pass : ExitCode::usage;
  }
  return commands.chosen();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return static_cast<int>(run(argc, argv));
  } catch (const triptych::core::NotSupported& error) {
    fmt::print(stderr, "triptych: {}\n", error.what());
    return static_cast<int>(ExitCode::cannot_judge);
  } catch (const std::exception& error) {
    fmt::print(stderr, "triptych: {}\n", error.what());
    return static_cast<int>(ExitCode::usage);
  }
}
