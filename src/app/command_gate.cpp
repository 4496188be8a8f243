#include <fmt/format.h>

#include <memory>
#include <set>

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
};

struct AcceptArguments {
  std::string plan;  // as it was typed
  std::string store = "triptych.sqlite";
  std::string baselines = default_baselines().string();
  std::string reason;
  std::string only;
  bool drop = false;
  bool forget_times = false;
};

core::ExitCode gate(const GateArguments& arguments) {
  refuse_overwriting({{"--store", arguments.store}, {"PLAN", arguments.plan}},
                     {{"--junit", arguments.junit}, {"--markdown", arguments.markdown}});
  std::set<judge::Check> checks;
  for (const std::string& name : arguments.checks) checks.insert(judge::check(name));
  const Registry registry = make_registry();
  record::Store store = open_to_judge(arguments.store);
  Truths truths(registry, store);
  const std::string plan = measure::plan_name(arguments.plan);
  judge::GateRequest request = request_of(truths, plan);
  request.devices = arguments.devices;
  request.required_devices = arguments.required;
  request.checks = checks;
  const judge::Baselines baselines(arguments.baselines, plan);
  const std::string run = latest_run_of(store, arguments.plan, arguments.store);
  const judge::GateResult result = judge::judge_run(store, run, baselines, request);
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
  judge::AcceptRequest request{
      .plan = plan,
      .reason = arguments.reason,
      .only = arguments.only,
      .date = today(),
      .drop = arguments.drop,
      .forget_times = arguments.forget_times,
      .truth = [&](const record::Record& record) { return truths.of(record).truth; }};
  const judge::GateRequest judged = request_of(truths, plan);
  // Errors against the limit and scores are baselines of the plans made for them.
  if (plan.ends_with("/accuracy")) request.limit = judged.limit;
  if (plan.ends_with("/stress")) request.stress = {judged.truth, judged.expectations};
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
                   "image,counters,statistics,timing,correlation,accuracy,stress (default: "
                   "those made for the plan)")
      ->delimiter(',');
  command->add_option("--device", arguments->devices, "Glob: judge only these (repeatable)");
  command->add_option("--require", arguments->required,
                      "Glob: a device that must have measured something (repeatable)");
  command->add_option("--junit", arguments->junit, "Write JUnit XML");
  command->add_option("--markdown", arguments->markdown, "Write a Markdown summary");
  command->add_flag("--json", arguments->json, "Print every finding as JSON");

  auto accepted = std::make_shared<AcceptArguments>();
  CLI::App* accepting = commands.add("accept", "Make a plan's latest run the baseline",
                                     [accepted] { return accept(*accepted); });
  add_run_plan(*accepting, accepted->plan);
  accepting->add_option("--reason", accepted->reason, "Why; kept in history.json")->required();
  accepting->add_option("--only", accepted->only, "Glob over configurations");
  accepting->add_flag("--drop", accepted->drop,
                      "Drop stored configurations that the run has no record of");
  accepting->add_flag("--forget-times", accepted->forget_times,
                      "Drop the times that were accepted before on the devices of this run");
  accepting->add_option("--store", accepted->store)->capture_default_str();
  add_baselines_option(*accepting, accepted->baselines);
}

}  // namespace triptych::app
