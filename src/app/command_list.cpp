#include <fmt/format.h>

#include "app/arguments.hpp"
#include "app/registry.hpp"
#include "core/json.hpp"

namespace triptych::app {
namespace {

struct ListArguments {
  PlanArguments plan;
  bool json = false;
};

core::ExitCode list(const ListArguments& arguments) {
  const Registry registry = make_registry();
  const measure::Plan plan = arguments.plan.load(registry.find_suite());
  const measure::Suite& suite = registry.suite(plan.suite);
  if (arguments.json) {
    core::Json configurations = core::Json::array();
    for (const measure::Configuration& each : plan.configurations) configurations.push_back(each);
    fmt::print("{}\n", core::Json{{"plan", plan.name},
                                  {"suite", plan.suite},
                                  {"varied", plan.varied},
                                  {"configurations", configurations}}
                           .dump(2));
    return core::ExitCode::pass;
  }
  for (const measure::Configuration& each : plan.configurations) {
    fmt::print("{}\n", measure::configuration_key(suite, each));
  }
  fmt::print(stderr, "{}: {} configurations\n", plan.name, plan.configurations.size());
  return core::ExitCode::pass;
}

}  // namespace

void add_list_command(Commands& commands) {
  auto arguments = std::make_shared<ListArguments>();
  CLI::App* command = commands.add("list", "Print the configurations of a plan",
                                   [arguments] { return list(*arguments); });
  arguments->plan.add_to(*command);
  command->add_flag("--json", arguments->json, "Print every factor of every configuration as JSON");
}

}  // namespace triptych::app
