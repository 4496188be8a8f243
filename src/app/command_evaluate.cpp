#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <system_error>

#include "app/arguments.hpp"
#include "app/evaluation.hpp"
#include "app/evaluation_text.hpp"
#include "app/listing.hpp"
#include "app/paths.hpp"
#include "app/saying.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "core/temporary_folder.hpp"
#include "judge/evaluation/runs.hpp"
#include "measure/plant.hpp"

namespace triptych::app {
namespace {

struct EvaluateArguments {
  std::vector<std::string> what{"compare", "correlation", "history"};
  bool measure = false;
  std::string out = "evaluation";
  std::string store;  // empty: runs.sqlite in `out`
  std::vector<std::string> plans{"volume/correlation", "particles/correlation"};
  std::vector<std::string> devices;
  int budget_s = 0;  // none
  std::size_t trials = 40;
  std::uint64_t seed = 1;
  bool json = false;
  EvaluationMaterial material{.plans = {}, .devices = {}, .sizes = {1, 2, 3, 5, 10, 20, 25}};

  [[nodiscard]] bool wants(std::string_view method) const {
    return std::ranges::find(what, method) != what.end();
  }
  [[nodiscard]] bool wants_runs() const { return wants("correlation") || wants("history"); }
  [[nodiscard]] std::filesystem::path blocks() const {
    return std::filesystem::path(out) / "blocks.jsonl";
  }
  [[nodiscard]] std::filesystem::path runs() const {
    return store.empty() ? std::filesystem::path(out) / "runs.sqlite"
                         : std::filesystem::path(store);
  }
};

void tell(const std::string& step) {
  say("{}\n", step);
}

void measure(const EvaluateArguments& arguments) {
  const Registry registry = make_registry();
  EvaluationMaterial material = arguments.material;
  for (const std::string& plan : arguments.plans) {
    material.plans.push_back(measure::load_plan(plan, {}, registry.find_suite()));
  }
  for (const double size : material.sizes) measure::check_plant(fmt::format("slowdown:{}", size));
  material.devices = choose_devices(list_devices(registry), arguments.devices);
  material.seed = arguments.seed;
  const bool both = arguments.wants("compare") && arguments.wants_runs();
  if (arguments.budget_s > 0) {
    material.budget = std::chrono::seconds(std::max(1, arguments.budget_s / (both ? 2 : 1)));
  }
  require_writable(arguments.out);
  if (arguments.wants("compare")) measure_blocks(material, registry, arguments.blocks(), tell);
  if (!arguments.wants_runs()) return;
  require_writable(arguments.runs().parent_path());
  record::Store store(arguments.runs(), record::Store::Mode::append);
  measure_runs(material, registry, store, tell);
}

judge::Tallies judge_runs(const EvaluateArguments& arguments) {
  judge::Tallies tallies;
  if (!std::filesystem::exists(arguments.runs())) return tallies;
  const record::Store store(arguments.runs(), record::Store::Mode::read);
  const core::TemporaryFolder scratch;  // for trials' own stores and baselines
  int number = 0;
  for (const judge::RunPool& pool : judge::pool_runs(store)) {
    tell(fmt::format("{}: {} unplanted runs, {} planted", pool.plan, pool.unplanted.size(),
                     pool.planted.size()));
    const auto folder = scratch.path() / std::to_string(number++);
    tallies.merge(judge::evaluate_runs(pool,
                                       {.most = arguments.trials,
                                        .seed = arguments.seed,
                                        .history = arguments.wants("history"),
                                        .correlation = arguments.wants("correlation")},
                                       folder));
  }
  return tallies;
}

core::ExitCode evaluate(const EvaluateArguments& arguments) {
  if (arguments.measure) measure(arguments);
  judge::Tallies tallies;
  if (arguments.wants("compare")) {
    tallies = judge::evaluate_comparison(read_blocks(arguments.blocks(), tell), arguments.trials,
                                         arguments.seed);
  }
  if (arguments.wants_runs()) tallies.merge(judge_runs(arguments));
  if (tallies.empty()) {
    throw core::NotSupported(fmt::format(
        "nothing to judge in {} and {}: measure first with `triptych evaluate --measure`",
        arguments.blocks().string(), arguments.runs().string()));
  }
  if (arguments.json) {
    fmt::print("{}\n", core::json_text(to_json(tallies), 2));
  } else {
    fmt::print("{}", to_text(tallies));
  }
  const auto aims = judge::aims(tallies);
  const bool missed =
      std::ranges::any_of(aims, [](const judge::Aim& aim) { return aim.met() == false; });
  return missed ? core::ExitCode::regression : core::ExitCode::pass;
}

void add_measuring_options(CLI::App& command, EvaluateArguments& arguments) {
  EvaluationMaterial& material = arguments.material;
  command.add_flag("--measure", arguments.measure,
                   "Measure first, adding to what is there; else judge what is there");
  command.add_option("--plan", arguments.plans, "Plans to measure (repeatable)")
      ->capture_default_str();
  command.add_option("--device", arguments.devices,
                     "Glob over device ids (repeatable; default: all)");
  command.add_option("--sizes", material.sizes, "Planted slowdowns in percent")
      ->delimiter(',')
      ->capture_default_str();
  command
      .add_option("--budget", arguments.budget_s,
                  "Seconds after which nothing more is measured (default: none)")
      ->check(CLI::Range(1, 10000000));
  const auto number = [&](const char* name, int& value, const char* summary, int least) {
    command.add_option(name, value, summary)
        ->capture_default_str()
        ->check(CLI::Range(least, 10000));
  };
  number("--configurations", material.configurations, "compare: how many of each plan", 1);
  number("--launches", material.launches, "compare: launches of both workers", 1);
  number("--blocks", material.blocks, "compare: blocks of turns in a launch, at most", 12);
  number("--rounds", material.rounds, "Unplanted runs of each plan", 1);
  number("--planted-rounds", material.planted_rounds, "Runs of each plan and size", 0);
}

}  // namespace

void add_evaluate_command(Commands& commands) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = commands.add(
      "evaluate", "Judge the judge: how often it finds planted slowdowns, and raises false alarms",
      [arguments] { return evaluate(*arguments); });
  command
      ->add_option("--what", arguments->what,
                   "compare (in turns), correlation (between devices), history (stored runs)")
      ->delimiter(',')
      ->check(CLI::IsMember({"compare", "correlation", "history"}))
      ->capture_default_str();
  command->add_option("--out", arguments->out, "Folder of blocks.jsonl and runs.sqlite")
      ->capture_default_str();
  command->add_option("--store", arguments->store, "Another SQLite file for the runs");
  command->add_option("--trials", arguments->trials, "Trials of one kind, at most")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command->add_option("--seed", arguments->seed, "Of turns and of trials")->capture_default_str();
  command->add_flag("--json", arguments->json, "Print everything as JSON");
  add_measuring_options(*command, *arguments);
}

}  // namespace triptych::app
