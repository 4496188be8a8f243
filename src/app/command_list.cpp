#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "app/arguments.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "record/short_name.hpp"

namespace triptych::app {
namespace {

struct ListArguments {
  std::string plan;  // a plan or the name of a suite
  PlanChoice choice;
  bool json = false;
};

// Returns, for example, "raycast | speed_of_light" or "0.015625 to 4096 | own". Returns an empty
// string if the levels cannot be listed.
std::string levels_text(const measure::Factor& factor) {
  const std::string words = fmt::format("{}", fmt::join(factor.levels, " | "));
  if (factor.kind != measure::FactorKind::number) return words;
  const std::string range = fmt::format("{} to {}", factor.minimum, factor.maximum);
  return words.empty() ? range : range + " | " + words;
}

void print_factor(const measure::Factor& factor) {
  const std::string levels = levels_text(factor);
  print_out("  {}: {}{}{}{}\n      {}\n", factor.name, levels, levels.empty() ? "" : "; ",
            factor.default_value.empty() ? "required" : "default " + factor.default_value,
            factor.determines_image ? "" : "; does not change the image", factor.summary);
}

core::Json json_of(const measure::Factor& factor) {
  core::Json json{{"name", factor.name},
                  {"levels", factor.levels},
                  {"default", factor.default_value},
                  {"decides_the_picture", factor.determines_image},
                  {"summary", factor.summary}};
  if (factor.kind == measure::FactorKind::number) {
    json["minimum"] = factor.minimum;
    json["maximum"] = factor.maximum;
  }
  return json;
}

struct CountedPlan {
  measure::Plan plan;  // without configurations
  std::size_t configurations;
};

std::vector<CountedPlan> plans_of(const measure::Suite& suite, const Registry& registry) {
  std::vector<CountedPlan> plans;
  for (const std::string_view name : suite.plan_names()) {
    std::size_t count = 0;
    measure::Plan plan =
        measure::list_plan(fmt::format("{}/{}", suite.name(), name), {}, registry.find_suite(), {},
                           [&](const measure::Suite&, const measure::Configuration&) { ++count; });
    plans.push_back({std::move(plan), count});
  }
  return plans;
}

void print_text(const measure::Suite& suite, const std::vector<CountedPlan>& plans) {
  print_out("factors of {}\n", suite.name());
  for (const measure::Factor& factor : suite.factors()) print_factor(factor);
  if (!suite.generators().empty()) print_out("data generators\n");
  for (const auto& [name, summary] : suite.generators()) {
    print_out("  generate:{}\n      {}\n", name, summary);
  }
  print_out("plans\n");
  for (const auto& [plan, count] : plans) {
    print_out("  {}: {} configurations\n      {}\n", plan.name, count, plan.summary);
  }
}

core::Json json_of(const measure::Suite& suite, const std::vector<CountedPlan>& plans) {
  core::Json json{{"suite", suite.name()},
                  {"factors", core::Json::array()},
                  {"generators", core::Json::array()},
                  {"plans", core::Json::array()}};
  for (const measure::Factor& factor : suite.factors()) json["factors"].push_back(json_of(factor));
  for (const auto& [name, summary] : suite.generators()) {
    json["generators"].push_back({{"name", name}, {"summary", summary}});
  }
  for (const auto& [plan, count] : plans) {
    json["plans"].push_back(
        {{"name", plan.name}, {"configurations", count}, {"summary", plan.summary}});
  }
  return json;
}

// Lists the factors and generators of the suite, and the plans that the suite provides.
core::ExitCode list_suite(const measure::Suite& suite, const Registry& registry, bool as_json) {
  const std::vector<CountedPlan> plans = plans_of(suite, registry);
  if (as_json) {
    print(json_of(suite, plans));
  } else {
    print_text(suite, plans);
  }
  return core::ExitCode::pass;
}

core::ExitCode print_json(const measure::Plan& plan) {
  core::Json configurations = core::Json::array();
  for (const measure::Configuration& each : plan.configurations) configurations.push_back(each);
  print({{"plan", plan.name},
         {"suite", plan.suite},
         {"varied", plan.varied},
         {"configurations", configurations}});
  return core::ExitCode::pass;
}

void print_name(const measure::Suite& suite, const std::string& plan,
                const measure::Configuration& configuration) {
  const std::string key = measure::configuration_key(suite, configuration);
  print_lines(record::short_name(suite.name(), plan, key) + "  " + key + "\n");
}

core::ExitCode list_plan(const ListArguments& arguments, const Registry& registry) {
  const auto& [name, choice, as_json] = arguments;
  if (as_json) return print_json(choice.load(name, registry.find_suite()));
  const std::string plan_name = measure::plan_name(name);
  std::size_t count = 0;
  if (choice.selects()) {
    const measure::Plan plan = choice.load(name, registry.find_suite());
    for (const measure::Configuration& each : plan.configurations) {
      print_name(registry.suite(plan.suite), plan_name, each);
    }
    count = plan.configurations.size();
    if (count == 0) throw nothing_selected(choice);
  } else {
    static_cast<void>(
        measure::list_plan(name, choice.overrides(), registry.find_suite(), choice.part(),
                           [&](const measure::Suite& suite, const measure::Configuration& each) {
                             print_name(suite, plan_name, each);
                             ++count;
                           }));
  }
  print_err("{}: {} configurations\n", plan_name, count);
  return core::ExitCode::pass;
}

core::ExitCode list(const ListArguments& arguments) {
  const Registry registry = make_registry();
  const auto suite =
      std::ranges::find(registry.suites, arguments.plan,
                        [](const auto& each) -> std::string { return std::string(each->name()); });
  if (suite == registry.suites.end()) return list_plan(arguments, registry);
  if (!arguments.choice.is_whole()) {
    throw core::InputError(fmt::format(
        "{0} is a suite, but options that select configurations need a plan, such as {0}/quick",
        arguments.plan));
  }
  return list_suite(**suite, registry, arguments.json);
}

}  // namespace

void add_list_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "list",
      "List the configurations of a plan, or the factors, data generators and plans of a suite",
      list);
  add_plan_option(command, arguments.plan);
  add_choice_options(command, arguments.choice);
  command.add_flag("--json", arguments.json, "Print all factors of every configuration as JSON");
  add_example(command, "triptych list volume/quick");
}

}  // namespace triptych::app
