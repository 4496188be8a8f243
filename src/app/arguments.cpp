#include "app/arguments.hpp"

#include <fmt/format.h>

#include "core/json_text.hpp"

namespace triptych::app {

CLI::App& Commands::add(const std::string& name, const std::string& summary,
                        std::function<core::ExitCode()> run) {
  CLI::App* command = program.add_subcommand(name, summary);
  command->callback([this, run = std::move(run)] { chosen = run; });
  return *command;
}

void add_example(CLI::App& command, const std::string& example) {
  command.footer(fmt::format("Example:\n  {}\n\n{}", example, command.get_footer()));
}

void add_choice_options(CLI::App& command, PlanChoice& choice) {
  command.add_option("--set", choice.set,
                     "factor=a,b: replace the plan's levels of this factor with a and b "
                     "(repeatable); write a comma inside a level as %2C");
  command.add_option("--shard", choice.shard,
                     "i/n: divide the plan into n parts and use only the i-th part");
  add_selection_options(command, choice);
}

void add_selection_options(CLI::App& command, PlanChoice& choice) {
  command.add_option("--filter", choice.filter,
                     "Use only configurations whose name or key matches this glob (repeatable); "
                     "`triptych list PLAN` prints names and keys");
  command.add_option("--caselist", choice.caselist,
                     "Use only the configurations listed in this file, one name or key per line");
  command.add_option("--fraction", choice.fraction,
                     "1/n: use only one n-th of the configurations; repeated calls select the same "
                     "configurations");
}

core::InputError nothing_selected(const PlanChoice& choice) {
  return core::InputError(
      fmt::format("{}: no configuration matches; `triptych list PLAN` prints names and keys",
                  choice.selection_text()));
}

void add_baselines_option(CLI::App& command, std::string& folder, const std::string& help) {
  command.add_option("--baselines", folder, help)->check([](const std::string& name) {
    return name.empty() ? "the name of the folder is empty" : std::string();
  });
}

void add_devices_option(CLI::App& command, std::vector<std::string>& globs) {
  command.add_option("--device", globs, "Use only devices that match this glob (repeatable)");
}

void add_inject_option(CLI::App& command, std::vector<std::string>& faults,
                       const std::string& help) {
  command.add_option("--inject", faults, help);
  command.add_option("--plant", faults)->group("");
}

void add_limit_option(CLI::App& command, int& seconds, const std::string& what) {
  command
      .add_option("--limit", seconds, fmt::format("Treat {} as hung after this many seconds", what))
      ->capture_default_str()
      ->check(CLI::Range(1, 86400));
}

void add_without_data_option(CLI::App& command, bool& without) {
  command.add_flag("--without-data", without,
                   "Accept that configurations are skipped if their data files are missing on this "
                   "machine, even if these configurations have baselines");
}

void add_verbose_option(CLI::App& command, bool& verbose) {
  command.add_flag("--verbose", verbose, "Print one line for each measured configuration");
}

void print(const core::Json& json, int indent) {
  fmt::print("{}\n", core::json_text(json, indent));
}

}  // namespace triptych::app
