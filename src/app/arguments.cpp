#include "app/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "record/factor_list.hpp"

namespace triptych::app {

CLI::App* Commands::add(const std::string& name, const std::string& summary,
                        std::function<core::ExitCode()> run) {
  CLI::App* command = program.add_subcommand(name, summary);
  command->callback([this, run = std::move(run)] { chosen = run; });
  return command;
}

void PlanArguments::add_to(CLI::App& command) {
  command.add_option("PLAN", plan, "A YAML file, or SUITE/PLAN such as volume/quick")->required();
  choice.add_to(command);
}

void PlanChoice::add_to(CLI::App& command) {
  command.add_option(
      "--set", set,
      "factor=a,b: replaces the plan's values of a factor (repeatable); a comma within a "
      "value is spelled %2C");
  command.add_option("--shard", shard, "i/n: only the i-th of n parts of the plan");
}

namespace {

// Throws core::InputError.
measure::Shard parse_shard(std::string_view text) {
  measure::Shard shard;
  const char* const end = text.data() + text.size();
  const auto [slash, index_error] = std::from_chars(text.data(), end, shard.index);
  if (index_error == std::errc{} && slash != end && *slash == '/') {
    const auto [rest, count_error] = std::from_chars(slash + 1, end, shard.count);
    if (count_error == std::errc{} && rest == end && shard.index >= 1 &&
        shard.index <= shard.count) {
      return shard;
    }
  }
  throw core::InputError(fmt::format("--shard {}: expected i/n with 1 <= i <= n", text));
}

}  // namespace

measure::Shard PlanChoice::shard_chosen() const {
  return shard.empty() ? measure::Shard{} : parse_shard(shard);
}

measure::Plan PlanChoice::load(const std::string& plan,
                               const measure::FindSuite& find_suite) const {
  return measure::load_plan(plan, parse_overrides(set), find_suite, shard_chosen());
}

void add_baselines_option(CLI::App& command, std::string& folder) {
  command.add_option("--baselines", folder, "Folder of the baselines")
      ->check([](const std::string& name) {
        return name.empty() ? "a folder needs a name" : std::string();
      });
}

void add_inject_option(CLI::App& command, std::vector<std::string>& faults,
                       const std::string& help) {
  command.add_option("--inject", faults, help);
  command.add_option("--plant", faults)->group("");
}

void add_limit_option(CLI::App& command, int& seconds, const std::string& what) {
  command
      .add_option("--limit", seconds, fmt::format("Seconds after which {} counts as hung", what))
      ->capture_default_str()
      ->check(CLI::Range(1, 86400));
}

measure::Overrides parse_overrides(const std::vector<std::string>& set) {
  measure::Overrides overrides;
  for (const std::string& each : set) {
    const auto equals = each.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == each.size()) {
      throw core::InputError(fmt::format("--set {}: expected factor=value or factor=a,b", each));
    }
    std::vector<std::string> values;
    for (std::size_t begin = equals + 1; begin <= each.size();) {
      const std::size_t end = std::min(each.find(',', begin), each.size());
      values.push_back(record::unescaped(std::string_view(each).substr(begin, end - begin)));
      begin = end + 1;
    }
    overrides.emplace_back(each.substr(0, equals), std::move(values));
  }
  return overrides;
}

std::vector<measure::InjectedFault> parse_faults(const std::vector<std::string>& faults) {
  std::vector<measure::InjectedFault> parsed;
  for (const std::string& each : faults) {
    const auto at = each.find('@');
    parsed.push_back({.fault = each.substr(0, at),
                      .only = at == std::string::npos ? std::string{} : each.substr(at + 1)});
  }
  return parsed;
}

}  // namespace triptych::app
