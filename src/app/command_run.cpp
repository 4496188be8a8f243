#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "app/arguments.hpp"
#include "app/listing.hpp"
#include "app/loading.hpp"
#include "app/measuring.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/saying.hpp"
#include "app/truth.hpp"
#include "measure/protocol/injected_fault.hpp"
#include "measure/request/error_request.hpp"
#include "measure/request/fastest.hpp"
#include "measure/system/process.hpp"
#include "measure/worker/worker.hpp"

namespace triptych::app {
namespace {

struct RunArguments {
  std::vector<std::string> plans;
  PlanChoice choice;
  std::vector<std::string> devices;
  std::string store = "triptych.sqlite";
  bool resume = false;
  std::set<std::pair<std::string, std::string>> again;
  int jobs = 0;
  int limit_s = standard_limit_s;
  std::optional<std::uint64_t> memory;  // bytes
  bool measure_every = false;
  bool brief = false;
  bool untimed = false;
  bool statistics = false;  // of an untimed run, too
  bool timed = false;
  std::vector<std::string> faults;
  std::optional<std::string> error;  // as it was typed
  bool chooses = false;              // tells the fastest of what a plan says "auto" of
  std::FILE* told_to = stdout;
};

std::string outcome_text(const record::Record& record) {
  if (record.outcome != record::Outcome::measured) {
    return fmt::format("{}: {}", record::name_of(record.outcome), record.reason);
  }
  if (!record.same_as.empty()) {
    return fmt::format("the same as {} ({})", record.same_as, record.reason);
  }
  const auto summary = record::summarise(record.time_ns());
  return summary ? fmt::format("{:.3f} ms ({})", summary->median / 1e6, record.clock())
                 : "measured";
}

// A line that rewrites itself on a terminal, a line per configuration elsewhere.
void show(const measure::Progress& progress) {
  if (progress.loading) return show_loading(*progress.loading);
  static const bool terminal = ::isatty(STDERR_FILENO) == 1;
  const std::string what = progress.record != nullptr ? outcome_text(*progress.record) : "";
  if (terminal) {
    say("\r\033[K{}/{} {} {} {} left {} s", progress.done, progress.total, progress.device,
        progress.configuration, what, progress.left.count());
    if (progress.done == progress.total) say("\n");
  } else if (progress.record != nullptr) {
    say("{}/{} {} {}: {}\n", progress.done, progress.total, progress.device, progress.configuration,
        what);
  }
}

void tell(const RunArguments& arguments, const measure::Plan& plan,
          const measure::RunResult& result) {
  std::string text = fmt::format(
      "{}: run {} in {}: {} measured, {} skipped, {} failed; {:.1f} s, {:.1f} % of it ours\n",
      plan.name, result.run, arguments.store, result.measured, result.skipped, result.failed,
      result.wall_ns / 1e9,
      result.devices_ns > 0 ? 100 * result.overhead_ns / result.devices_ns : 0.0);
  if (result.there_before > 0) {
    text += fmt::format("{} of them were there before\n", result.there_before);
  }
  if (result.taken_over > 0) {
    text += fmt::format(
        "{} of them took over another configuration's frames, which their scene cannot tell "
        "apart; --measure-every measures them too\n",
        result.taken_over);
  }
  fmt::print(arguments.told_to, "{}", text);
}

// A factor belongs to one suite, an error to its scenes.
void refuse_for_several(const RunArguments& arguments) {
  if (arguments.plans.size() < 2) return;
  if (!arguments.choice.set.empty()) {
    throw core::InputError("--set changes one plan: give it alone, or a YAML file for each");
  }
  if (arguments.error) throw core::InputError("--error asks of one plan: give it alone");
}

std::vector<measure::Plan> load_plans(const RunArguments& arguments, const Registry& registry) {
  refuse_for_several(arguments);
  std::vector<measure::Plan> plans;
  for (const std::string& name : arguments.plans) {
    measure::Plan plan = arguments.choice.load(name, registry.find_suite());
    if (std::ranges::find(plans, plan.name, &measure::Plan::name) != plans.end()) {
      throw core::InputError(
          fmt::format("two plans are called {}: a plan's runs are known by its name", plan.name));
    }
    const bool chooses = arguments.chooses && !plan.automatic.empty();
    if (chooses && arguments.untimed && !plan.counted()) {
      throw core::InputError(
          fmt::format("{}: auto is chosen by time, of which --untimed tells none", plan.name));
    }
    if ((arguments.timed || chooses) && !plan.counted()) {
      plan.checks.insert(record::Check::timing);
    }
    plans.push_back(std::move(plan));
  }
  return plans;
}

std::vector<std::string> worker_command(const RunArguments& arguments) {
  std::vector<std::string> command{own_program(), "worker"};
  if (arguments.memory) {
    command.insert(command.end(), {"--memory", fmt::to_string(*arguments.memory)});
  }
  command.emplace_back("--device");
  return command;
}

measure::RunOptions options_of(const RunArguments& arguments) {
  measure::Protocol protocol = arguments.brief ? measure::brief_protocol : measure::Protocol{};
  protocol.timed = !arguments.untimed;
  protocol.statistics = protocol.timed || arguments.statistics;
  protocol.measure_every = arguments.measure_every;
  return {
      .protocol = protocol,
      .limit = std::chrono::seconds(arguments.limit_s),
      .resume = arguments.resume,
      .again = arguments.again,
      .faults = parse_faults(arguments.faults),
      .jobs = arguments.jobs,
      .worker_command = worker_command(arguments),
  };
}

struct Told {
  bool scored = false;                      // some plan's failures are told by its scores
  std::vector<measure::RunResult> results;  // in the order of the plans
  bool error_kept = true;                   // a requested error, by every device in every scene
};

// Where and with what plans are measured.
struct Bench {
  const RunArguments& arguments;
  const Registry& registry;
  std::vector<std::string> devices;
  record::Store& store;
};

bool hits(const measure::InjectedFault& fault, const Bench& bench, const measure::Plan& plan) {
  const measure::Suite& suite = bench.registry.suite(plan.suite);
  return std::ranges::any_of(plan.configurations, [&](const measure::Configuration& each) {
    const std::string key = measure::configuration_key(suite, each);
    return std::ranges::any_of(bench.devices, [&](const std::string& device) {
      return !measure::faults_for({&fault, 1}, key, device).empty();
    });
  });
}

// Who injects a fault and sees a pass would think that it was not caught.
void tell_faults_that_hit_nothing(const Bench& bench, const std::vector<measure::Plan>& plans,
                                  const std::vector<measure::InjectedFault>& faults) {
  for (const measure::InjectedFault& fault : faults) {
    const auto hit = [&](const measure::Plan& plan) { return hits(fault, bench, plan); };
    if (std::ranges::any_of(plans, hit)) continue;
    say("triptych: --inject {}@{} hits nothing: no configuration or device is called so; `triptych "
        "list PLAN` tells their names, which leave defaults out\n",
        fault.fault, fault.only);
  }
}

std::vector<measure::RunResult> measure_and_tell(const Bench& bench,
                                                 const std::vector<measure::Plan>& plans) {
  const measure::RunOptions options = options_of(bench.arguments);
  std::vector<measure::PlannedRun> runs;
  runs.reserve(plans.size());
  for (const measure::Plan& plan : plans) {
    runs.push_back({plan, bench.registry.suite(plan.suite), options});
  }
  std::vector<measure::RunResult> results =
      measure::run_plans(runs, bench.devices, bench.store, show);
  tell_faults_that_hit_nothing(bench, plans, options.faults);
  for (std::size_t i = 0; i < plans.size(); ++i) tell(bench.arguments, plans[i], results[i]);
  return results;
}

// What keeps the requested error, and of it the fastest per scene and device.
Told measure_within_error(const Bench& bench, const measure::Plan& plan) {
  const auto wanted = accuracy::parse_requested_error(*bench.arguments.error);
  measure::SuiteWithTruth& suite = bench.registry.suite(plan.suite);
  Truths truths(bench.registry, bench.store);
  const measure::RequestPictures pictures = pictures_of(truths);
  const measure::ErrorRequest request = measure::request_error(
      plan, suite, wanted, pictures, [](const std::string& what) { say("{}\n", what); });
  Told told{.error_kept = request.out_of_reach.empty()};
  std::vector<record::Record> records;
  if (!request.plan.configurations.empty()) {
    told.results = measure_and_tell(bench, {request.plan});
    records = bench.store.records(told.results.front().run);
  }
  for (const measure::ErrorAnswer& answer :
       measure::answer_error(records, suite, wanted, pictures)) {
    fmt::print("{}\n", describe(answer, wanted));
    told.error_kept = told.error_kept && answer.record != nullptr;
  }
  for (const std::string& scene : request.out_of_reach) fmt::print("{}\n", scene);
  return told;
}

void tell_the_fastest(const Bench& bench, const measure::Plan& plan, const std::string& run) {
  if (plan.automatic.empty()) return;
  const std::vector<record::Record> records = bench.store.records(run);
  for (const measure::FastestAnswer& answer :
       measure::answer_fastest(records, bench.registry.suite(plan.suite), plan.automatic)) {
    fmt::print("{}\n", describe(answer, plan.automatic));
  }
}

// Measures as the arguments say and says in a few lines how it went.
Told run_and_tell(const RunArguments& arguments) {
  const Registry registry = make_registry();
  const std::vector<measure::Plan> plans = load_plans(arguments, registry);
  const std::vector<std::string> devices =
      choose_devices(list_devices(registry), arguments.devices);
  require_writable(std::filesystem::path(arguments.store).parent_path());
  record::Store store(arguments.store, record::Store::Mode::append);
  const Bench bench{arguments, registry, devices, store};
  if (arguments.error) return measure_within_error(bench, plans.front());
  Told told{.results = measure_and_tell(bench, plans)};
  for (std::size_t i = 0; arguments.chooses && i < plans.size(); ++i) {
    tell_the_fastest(bench, plans[i], told.results[i].run);
  }
  told.scored = std::ranges::any_of(
      plans, [](const measure::Plan& plan) { return plan.checks.contains(record::Check::stress); });
  return told;
}

// For commands that have a --resume.
Told run_resumably(const RunArguments& arguments) {
  try {
    return run_and_tell(arguments);
  } catch (const measure::Interrupted& interrupted) {
    throw measure::Interrupted(interrupted.signal(),
                               "interrupted; what was measured is in the store, --resume goes on");
  }
}

bool has_measured(const measure::RunResult& result) {
  return result.measured > 0;
}

bool has_told(const measure::RunResult& result) {
  return result.measured + result.failed > 0;
}

// Where nothing of a plan is measured there is nothing that anybody could judge.
core::ExitCode run(const RunArguments& arguments) {
  const Told told = run_resumably(arguments);
  const bool measured = std::ranges::all_of(told.results, has_measured) && told.error_kept;
  return measured ? core::ExitCode::pass : core::ExitCode::cannot_judge;
}

// As a CTest fixture: a configuration that failed fails the test – but for a stress case, whose
// score tells of it – and nothing but skips skips it.
core::ExitCode run_as_test(const RunArguments& arguments) {
  const Told told = run_and_tell(arguments);
  const std::vector<measure::RunResult>& results = told.results;
  const bool failed = std::ranges::any_of(
      results, [](const measure::RunResult& result) { return result.failed > 0; });
  if (failed && !told.scored) return core::ExitCode::regression;
  return std::ranges::all_of(results, has_told) ? core::ExitCode::pass : core::ExitCode::skip;
}

// From here on. Valgrind holds nobody to it.
void limit_own_memory(std::uint64_t bytes) {
  const rlimit limit{bytes, bytes};
  if (::setrlimit(RLIMIT_DATA, &limit) != 0) {
    throw core::InputError(fmt::format("--memory {}: more than this user may allocate", bytes));
  }
}

core::ExitCode serve(const std::string& device, const std::optional<std::uint64_t>& memory) {
  if (memory) limit_own_memory(*memory);
  const Registry registry = make_registry();
  const std::string api = device.substr(0, device.find(':'));
  return static_cast<core::ExitCode>(
      measure::serve_worker(registry.backend(api), device, registry.find_suite(),
                            measure::Process::child_request_fd, measure::Process::child_answer_fd));
}

void add_worker_command(Commands& commands) {
  auto device = std::make_shared<std::string>();
  auto memory = std::make_shared<std::optional<std::uint64_t>>();
  CLI::App* worker = commands.add("worker", "Serve one device (started by run)",
                                  [device, memory] { return serve(*device, *memory); });
  worker->add_option("--device", *device)->required();
  worker->add_option("--memory", *memory);
  worker->group("");  // not shown: only `run` starts it
  auto api = std::make_shared<std::string>();
  CLI::App* listing =
      commands.add("list-api", "List the devices of one API (started by devices)", [api] {
        return answer_listing(make_registry(), *api, measure::Process::child_request_fd,
                              measure::Process::child_answer_fd);
      });
  listing->add_option("API", *api)->required();
  listing->group("");
}

void add_run_options(CLI::App& command, RunArguments& arguments) {
  command.add_option("PLAN", arguments.plans, "A YAML file, or SUITE/PLAN such as volume/quick")
      ->required();
  arguments.choice.add_to(command);
  command.add_option("--device", arguments.devices,
                     "Glob over device ids (repeatable; default: all)");
  command.add_option("--store", arguments.store, "SQLite file for the records")
      ->capture_default_str();
  add_limit_option(command, arguments.limit_s, "a configuration");
  constexpr std::uint64_t least_memory = std::uint64_t{64} << 20;
  command
      .add_option("--memory", arguments.memory,
                  "What a worker may allocate, such as 4G: data that need more fail their "
                  "configurations (default: no limit; Valgrind holds no worker to it)")
      ->transform(CLI::AsSizeValue(false))
      ->check(CLI::Range(least_memory, std::numeric_limits<std::uint64_t>::max()));
  command.add_flag("--untimed", arguments.untimed,
                   "One frame for the picture and one for the counters: no times, no statistics");
  command
      .add_flag("--timed", arguments.timed,
                "Times too, of plans that are not judged by them, such as SUITE/accuracy")
      ->excludes("--untimed");
  command.add_flag("--measure-every", arguments.measure_every,
                   "Measure configurations too that their scene cannot tell from one before");
  add_inject_option(
      command, arguments.faults,
      "Inject a fault to prove that the gate catches it: " + measure::fault_names() +
          "; FAULT@factor=level,… or FAULT@GLOB limits it to configurations or devices");
}

}  // namespace

void measure_plans(const Measuring& measuring) {
  RunArguments arguments;
  arguments.plans = measuring.plans;
  arguments.choice = measuring.choice;
  arguments.devices = measuring.devices;
  arguments.store = measuring.store;
  arguments.resume = measuring.resume;
  arguments.again = measuring.again;
  arguments.jobs = measuring.jobs;
  arguments.faults = measuring.faults;
  arguments.brief = measuring.brief;
  arguments.untimed = measuring.untimed;
  arguments.statistics = true;
  arguments.told_to = stderr;
  static_cast<void>(run_resumably(arguments));
}

void add_run_commands(Commands& commands) {
  auto arguments = std::make_shared<RunArguments>();
  arguments->chooses = true;
  CLI::App* command = commands.add("run", "Measure a plan on the devices of this machine",
                                   [arguments] { return run(*arguments); });
  add_run_options(*command, *arguments);
  command->add_flag("--resume", arguments->resume, "Go on with the plan's latest run in the store");
  command
      ->add_option("--error", arguments->error,
                   "E or E:METRIC, with rms (the default), covered, p99.9 or max: the error "
                   "against the limit of each scene. Measures only what keeps it, chooses step, "
                   "quadrature, ert, adapt and skip, and tells the fastest")
      ->excludes("--untimed");

  auto tested = std::make_shared<RunArguments>();
  tested->resume = true;  // every device adds its part to the run that test-start began
  tested->brief = true;
  CLI::App* test = commands.add("test-measure", "Measure one device as a CTest fixture",
                                [tested] { return run_as_test(*tested); });
  add_run_options(*test, *tested);
  test->group("");
  add_worker_command(commands);
}

}  // namespace triptych::app
