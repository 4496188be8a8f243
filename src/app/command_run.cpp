// The `run` command, and the hidden commands of the processes that it starts.

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <limits>

#include "app/measure_plans.hpp"
#include "app/registry.hpp"
#include "measure/system/process.hpp"
#include "measure/worker/listing.hpp"
#include "measure/worker/worker.hpp"

namespace triptych::app {
namespace {

using measure::RunResult;

// Measures the plans. Returns cannot_judge if a plan has no measured configuration, or if the
// requested error was not met.
core::ExitCode run(const MeasureRequest& request) {
  const auto [scored, results, error_met] = measure_resumably(request);
  const bool measured =
      std::ranges::all_of(results, [](const RunResult& result) { return result.measured > 0; });
  return measured && error_met ? core::ExitCode::pass : core::ExitCode::cannot_judge;
}

// Measures plans as a CTest fixture. The test is skipped if every configuration is skipped. It
// fails if a configuration fails, unless the plan has the check `stress`: the failures then lower
// the scores, which a separate test reports.
core::ExitCode run_as_test(const MeasureRequest& request) {
  const auto [scored, results, error_met] = measure_and_print(request);
  const bool failed =
      std::ranges::any_of(results, [](const RunResult& result) { return result.failed > 0; });
  if (failed && !scored) return core::ExitCode::regression;
  const bool not_skipped = std::ranges::all_of(
      results, [](const RunResult& result) { return result.measured + result.failed > 0; });
  return not_skipped ? core::ExitCode::pass : core::ExitCode::skip;
}

// Limits the memory of this process from now on. Has no effect under Valgrind.
void limit_own_memory(std::uint64_t bytes) {
  const rlimit limit{bytes, bytes};
  if (::setrlimit(RLIMIT_DATA, &limit) != 0) {
    throw core::InputError(fmt::format(
        "--memory {}: this exceeds the user's hard limit on memory (ulimit -Hd)", bytes));
  }
}

struct WorkerArguments {
  std::string device;
  std::optional<std::uint64_t> memory;
};

core::ExitCode serve(const WorkerArguments& arguments) {
  const auto& [device, memory] = arguments;
  if (memory) limit_own_memory(*memory);
  const Registry registry = make_registry();
  return static_cast<core::ExitCode>(measure::serve_worker(
      registry.backend(device.substr(0, device.find(':'))), device, registry.find_suite(),
      measure::Process::child_request_fd, measure::Process::child_answer_fd));
}

core::ExitCode list_api(const std::string& api) {
  measure::answer_listing(make_registry().backend(api));
  return core::ExitCode::pass;
}

// Adds the commands that this program runs in child processes (measure/worker/own_program.hpp).
// They are hidden from --help.
void add_worker_commands(Commands& commands) {
  auto [worker, arguments] = commands.add("worker", "Draw on one device (started by run)", serve);
  worker.add_option("--device", arguments.device)->required();
  worker.add_option("--memory", arguments.memory);
  worker.group("");
  auto [listing, api] =
      commands.add("list-api", "List the devices of one API (started by devices)", list_api);
  listing.add_option("API", api)->required();
  listing.group("");
}

void add_run_options(CLI::App& command, MeasureRequest& request) {
  add_plan_option(command, request.plans);
  add_choice_options(command, request.choice);
  command.add_option("--device", request.devices,
                     "Measure only devices that match this glob (repeatable; default: all)");
  command.add_option("--store", request.store, "Write the results to this SQLite file")
      ->capture_default_str();
  add_limit_option(command, request.limit_s, "a configuration");
  constexpr std::uint64_t min_memory = std::uint64_t{64} << 20;
  command
      .add_option("--memory", request.memory,
                  "Limit the memory that a worker process may allocate, for example to 4G; a "
                  "configuration that needs more fails (default: no limit; has no effect under "
                  "Valgrind)")
      ->transform(CLI::AsSizeValue(false))
      ->check(CLI::Range(min_memory, std::numeric_limits<std::uint64_t>::max()));
  add_verbose_option(command, request.verbose);
  command.add_flag("--untimed", request.untimed,
                   "For each configuration, draw only one frame for the image and one frame for "
                   "the counters; omit frame times and driver statistics");
  command
      .add_flag(
          "--timed", request.timed,
          "Measure frame times even for plans without the check `timing`, such as SUITE/accuracy")
      ->excludes("--untimed");
  command.add_flag(
      "--measure-every", request.measure_every,
      "Also measure configurations that do exactly the same work as another configuration of the "
      "same scene");
  add_inject_option(
      command, request.faults,
      "Inject a fault to check that the gate detects it: " + measure::fault_names() +
          "; FAULT@factor=level,… limits the fault to matching configurations, and FAULT@GLOB to "
          "matching devices");
}

}  // namespace

void add_run_commands(Commands& commands) {
  auto [command, request] =
      commands.add("run", "Measure a plan on the devices of this machine", run,
                   {.report_fastest = true, .report_unmeasured = true, .report_clocks = true});
  add_run_options(command, request);
  command.add_flag("--resume", request.resume, "Continue each plan's latest run in the store");
  add_example(command, "triptych run volume/quick --device 'vulkan:*' --store results.sqlite");
  command
      .add_option(
          "--error", request.error,
          "E or E:METRIC, where METRIC is rms (default), covered, p99.9 or max (only for volumes): "
          "search for fast levels of the factors step, quadrature, ert, adapt and skip for which "
          "the error relative to the scene's limit image (the exact ray integral) is at most E, "
          "measure them, and compare the devices and techniques; factors named by --set keep "
          "their levels, and the plan's levels of the others are ignored")
      ->excludes("--untimed");

  // Each call of `test-measure` measures one device. All calls add their records to one run,
  // because `resume` is set. `test-start` has already deleted the runs of earlier tests.
  auto [test, tested] = commands.add("test-measure", "Measure one device as a CTest fixture",
                                     run_as_test, {.resume = true, .brief = true});
  add_run_options(test, tested);
  test.group("");
  add_worker_commands(commands);
}

}  // namespace triptych::app
