#include <fmt/format.h>

#include <memory>

#include "app/arguments.hpp"
#include "app/judging.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/truth.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "judge/gate/gate.hpp"
#include "measure/plan.hpp"
#include "report/junit.hpp"
#include "report/markdown.hpp"

namespace triptych::app {
namespace {

struct GateArguments {
  std::string plan;  // as it was typed
  std::string store = "triptych.sqlite";
  std::string baselines = default_baselines().string();
  std::vector<std::string> checks;
  std::vector<std::string> devices;
  std::vector<std::string> required;
  std::string junit;
  std::string markdown;
  bool json = false;
  bool times = false;
};

struct AcceptArguments {
  std::string plan;  // as it was typed
  std::string store = "triptych.sqlite";
  std::string baselines = default_baselines().string();
  std::string reason;
  std::string only;
  bool drop = false;
};

// The request to judge a plan as it is now: one that cannot be read is judged by nothing.
judge::GateRequest request_for(const GateArguments& arguments, const Registry& registry,
                               Truths& truths) {
  const measure::Plan plan = measure::load_plan(arguments.plan, {}, registry.find_suite());
  judge::GateRequest request = request_of(truths, plan.name);
  request.devices = arguments.devices;
  request.required_devices = arguments.required;
  for (const std::string& name : arguments.checks) request.checks.insert(judge::check(name));
  request.times_decide = arguments.times;
  request.plan_hash = plan.hash;
  const measure::Suite& suite = registry.suite(plan.suite);
  for (const measure::Configuration& each : plan.configurations) {
    request.expected.push_back(measure::configuration_key(suite, each));
  }
  return request;
}

core::ExitCode gate(const GateArguments& arguments) {
  refuse_overwriting({{"--store", arguments.store}, {"PLAN", arguments.plan}},
                     {{"--junit", arguments.junit}, {"--markdown", arguments.markdown}});
  const Registry registry = make_registry();
  record::Store store = open_to_judge(arguments.store);
  Truths truths(registry, store);
  const judge::GateRequest request = request_for(arguments, registry, truths);
  const judge::GateResult result =
      judge::judge_run(store, latest_run_of(store, arguments.plan, arguments.store),
                       judge::Baselines(arguments.baselines, request.plan), request);
  if (!arguments.junit.empty()) write_text(arguments.junit, report::junit(result));
  if (!arguments.markdown.empty()) write_text(arguments.markdown, report::markdown(result));
  if (arguments.json) {
    fmt::print("{}\n", core::json_text(judge::to_json(result), 2));
  } else {
    print_text(result);
  }
  return result.exit_code();
}

core::ExitCode accept(const AcceptArguments& arguments) {
  const Registry registry = make_registry();
  record::Store store = open_to_judge(arguments.store);
  Truths truths(registry, store);
  const std::string plan = measure::plan_name(arguments.plan);
  const judge::GateRequest judged = request_of(truths, plan);
  const judge::AcceptRequest request{
      .plan = plan,
      .reason = arguments.reason,
      .only = arguments.only,
      .date = today(),
      .drop = arguments.drop,
      .truth = [&](const record::Record& record) { return truths.of(record).truth; },
      .data_hash = judged.data_hash,
      .limit = judged.limit,
      .stress = judge::StressTruths{judged.truth, judged.expectations}};
  const std::vector<std::string> changes = judge::accept(
      store, latest_run_of(store, arguments.plan, arguments.store), arguments.baselines, request);
  for (const std::string& change : changes) fmt::print("{}\n", change);
  fmt::print("{} changes under {}; review them before you commit\n", changes.size(),
             arguments.baselines);
  return core::ExitCode::pass;
}

// Whose latest run is meant.
void add_run_plan(CLI::App& command, std::string& plan) {
  command.add_option("PLAN", plan, "SUITE/PLAN or the YAML file, as it was run")->required();
}

}  // namespace

void add_gate_commands(Commands& commands) {
  auto arguments = std::make_shared<GateArguments>();
  CLI::App* command =
      commands.add("gate", "Judge a plan's latest run: truth, baselines, statistics",
                   [arguments] { return gate(*arguments); });
  add_run_plan(*command, arguments->plan);
  command->add_option("--store", arguments->store)->capture_default_str();
  add_baselines_option(*command, arguments->baselines);
  command
      ->add_option("--check", arguments->checks,
                   "image,counters,statistics,cost,memory,timing,correlation,accuracy,stress "
                   "(default: those of the plan)")
      ->delimiter(',');
  command->add_option("--device", arguments->devices, "Glob: judge only these (repeatable)");
  command->add_option("--require", arguments->required,
                      "Glob: a device that must have measured something (repeatable)");
  command->add_option("--junit", arguments->junit, "Write JUnit XML");
  command->add_option("--markdown", arguments->markdown, "Write a Markdown summary");
  command->add_flag("--json", arguments->json, "Print every finding as JSON");
  command->add_flag("--times", arguments->times,
                    "Times decide: for a machine that is kept for measuring; else they advise");

  auto accepted = std::make_shared<AcceptArguments>();
  CLI::App* accepting = commands.add("accept", "Make a plan's latest run the baseline",
                                     [accepted] { return accept(*accepted); });
  add_run_plan(*accepting, accepted->plan);
  accepting->add_option("--reason", accepted->reason, "Why; kept in history.json")->required();
  accepting->add_option("--only", accepted->only, "Glob over configurations");
  accepting->add_flag(
      "--drop", accepted->drop,
      "Drop stored configurations that the run has no record of, and files that are "
      "not as they were accepted");
  accepting->add_option("--store", accepted->store)->capture_default_str();
  add_baselines_option(*accepting, accepted->baselines);
}

}  // namespace triptych::app
