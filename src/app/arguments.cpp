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
  command.add_option(
      "--set", choice.set,
      "factor=a,b: replace the plan's values of a factor (repeatable); write a comma inside a "
      "value as %2C");
  command.add_option("--shard", choice.shard, "i/n: only the i-th of n parts of the plan");
}

void add_baselines_option(CLI::App& command, std::string& folder) {
  command
      .add_option(
          "--baselines", folder,
          "Folder with the baselines (default: ./baselines, else those that were installed)")
      ->check([](const std::string& name) {
        return name.empty() ? "a folder needs a name" : std::string();
      });
}

void add_devices_option(CLI::App& command, std::vector<std::string>& globs) {
  command.add_option("--device", globs, "Only devices that match this glob (repeatable)");
}

void add_inject_option(CLI::App& command, std::vector<std::string>& faults,
                       const std::string& help) {
  command.add_option("--inject", faults, help);
  command.add_option("--plant", faults)->group("");
}

void add_limit_option(CLI::App& command, int& seconds, const std::string& what) {
  command
      .add_option("--limit", seconds,
                  fmt::format("Seconds after which {} is regarded as hung", what))
      ->capture_default_str()
      ->check(CLI::Range(1, 86400));
}

void print(const core::Json& json, int indent) {
  fmt::print("{}\n", core::json_text(json, indent));
}

}  // namespace triptych::app
