#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "app/arguments.hpp"
#include "app/loading.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/saying.hpp"
#include "app/truth.hpp"
#include "comparison/comparison.hpp"
#include "comparison/text.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "core/quoting.hpp"
#include "measure/plant.hpp"

namespace triptych::app {
namespace {

struct CompareArguments {
  PlanArguments plan;
  std::string a;
  std::string b;
  std::string a_program;
  std::string b_program;
  std::string store = "triptych.sqlite";
  std::vector<std::string> plants;
  int budget_s = 0;  // none
  int limit_s = 60;
  std::uint64_t seed = 1;
  bool json = false;
};

// Whether the text goes on with NAME=: a comma before it ends the value before.
bool begins_a_variable(std::string_view text) {
  const auto letter = [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
  };
  if (text.empty() || !letter(text.front())) return false;
  const auto* end = std::ranges::find_if_not(
      text, [&](char c) { return letter(c) || std::isdigit(static_cast<unsigned char>(c)); });
  return end != text.end() && *end == '=';
}

// "DEVICE,NAME=VALUE,…"; a value may hold commas that no NAME= follows.
measure::SideOptions parse_side(std::string_view option, const std::string& text,
                                const std::string& program) {
  measure::SideOptions side;
  std::string_view rest(text);
  side.device = rest.substr(0, rest.find(','));
  if (side.device.find(':') == std::string::npos) {
    throw core::InputError(fmt::format(
        "{} {}: expected a device such as vulkan:lavapipe, `triptych devices` lists them", option,
        text));
  }
  rest.remove_prefix(side.device.size());
  while (!rest.empty()) {
    rest.remove_prefix(1);  // the comma
    if (!begins_a_variable(rest)) {
      throw core::InputError(
          fmt::format("{} {}: expected NAME=VALUE after the device, got '{}'", option, text, rest));
    }
    std::size_t end = rest.find(',');
    while (end != std::string_view::npos && !begins_a_variable(rest.substr(end + 1))) {
      end = rest.find(',', end + 1);
    }
    side.environment.emplace_back(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end);
  }
  if (!program.empty() && ::access(program.c_str(), X_OK) != 0) {
    throw core::InputError(fmt::format("{}-program {}: no program to run", option, program));
  }
  side.command = {program.empty() ? own_program() : std::filesystem::absolute(program).string(),
                  "worker", "--device"};
  return side;
}

// A line that rewrites itself on a terminal, a line per step elsewhere.
void show(const comparison::ComparisonProgress& progress) {
  if (progress.loading) return show_loading(*progress.loading);
  static const bool terminal = ::isatty(STDERR_FILENO) == 1;
  if (terminal) say("\r\033[K");
  say("{}/{} {}: {}, left at most {} s", progress.done, progress.total, progress.stage,
      progress.configuration, progress.left.count());
  if (!terminal) say("\n");
}

comparison::ComparisonCommand command_of(const CompareArguments& arguments,
                                         const measure::Plan& plan) {
  comparison::ComparisonCommand command{
      .plan = arguments.plan.plan,
      .sides = fmt::format("--a {} --b {}", core::shell_quoted(arguments.a),
                           core::shell_quoted(arguments.b)),
      .varied = plan.varied};
  if (!arguments.a_program.empty())
    command.sides += " --a-program " + core::shell_quoted(arguments.a_program);
  if (!arguments.b_program.empty())
    command.sides += " --b-program " + core::shell_quoted(arguments.b_program);
  for (const std::string& plant : arguments.plants)
    command.sides += " --plant " + core::shell_quoted(plant);
  // What the command line set to one value is no longer varied, but must be said again.
  for (const auto& [factor, values] : parse_overrides(arguments.plan.choice.set)) {
    if (std::ranges::find(command.varied, factor) == command.varied.end()) {
      command.varied.push_back(factor);
    }
  }
  return command;
}

core::ExitCode run_comparison(const CompareArguments& arguments) {
  const Registry registry = make_registry();
  comparison::ComparisonOptions options{
      .plan = arguments.plan.load(registry.find_suite()),
      .a = parse_side("--a", arguments.a, arguments.a_program),
      .b = parse_side("--b", arguments.b, arguments.b_program),
      .plants = parse_plants(arguments.plants),
      .limit = std::chrono::seconds(arguments.limit_s),
      .seed = arguments.seed,
  };
  for (const measure::Plant& plant : options.plants) measure::check_plant(plant.fault);
  if (arguments.budget_s > 0) options.budget = std::chrono::seconds(arguments.budget_s);
  require_writable(std::filesystem::path(arguments.store).parent_path());
  record::Store store(arguments.store, record::Store::Mode::append);
  store.require_whole();  // truths come from it
  Truths truths(registry, store);
  const comparison::ComparisonResult result = [&] {
    try {
      return comparison::compare(
          options, registry.suite(options.plan.suite),
          [&](const record::Record& record) -> const judge::TruthPair& {
            return truths.of(record);
          },
          show);
    } catch (const measure::Interrupted&) {
      throw core::Error("interrupted; a comparison keeps nothing, begin it again");
    }
  }();
  if (::isatty(STDERR_FILENO) == 1) say("\r\033[K");
  const comparison::ComparisonCommand command = command_of(arguments, options.plan);
  if (arguments.json) {
    fmt::print("{}\n", core::json_text(to_json(result, command), 2));
  } else {
    fmt::print("{}", to_text(result, command));
  }
  return result.exit_code();
}

}  // namespace

void add_compare_command(Commands& commands) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = commands.add(
      "compare", "Measure two devices, drivers or builds in turns and say what differs",
      [arguments] { return run_comparison(*arguments); });
  arguments->plan.add_to(*command);
  constexpr const char* side = "DEVICE[,NAME=VALUE]…: with variables set for this side alone";
  command->add_option("--a", arguments->a, side)->required();
  command->add_option("--b", arguments->b, side)->required();
  command->add_option("--a-program", arguments->a_program,
                      "Another build of triptych to measure a");
  command->add_option("--b-program", arguments->b_program,
                      "Another build of triptych to measure b");
  command
      ->add_option("--budget", arguments->budget_s,
                   "Seconds after which no doubt is followed any further (default: none)")
      ->check(CLI::Range(1, 1000000));
  command
      ->add_option("--limit", arguments->limit_s, "Seconds after which one answer counts as hung")
      ->capture_default_str()
      ->check(CLI::Range(1, 86400));
  command->add_option("--store", arguments->store, "SQLite file that keeps the truths")
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Of the order of turns")->capture_default_str();
  command->add_option("--plant", arguments->plants,
                      "Plant a fault into side b, to prove that it is found; as for run");
  command->add_flag("--json", arguments->json, "Print everything as JSON");
}

}  // namespace triptych::app
