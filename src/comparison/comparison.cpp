#include "comparison/comparison.hpp"

#include <array>
#include <map>
#include <utility>

#include "comparison/times.hpp"
#include "measure/system/environment.hpp"
#include "measure/system/stopwatch.hpp"

namespace triptych::comparison {
namespace {

measure::RunOptions options_for(const measure::SideOptions& side,
                                const ComparisonOptions& options) {
  return {.protocol = measure::brief_protocol,
          .limit = options.limit,
          .faults = {},
          .worker_command = side.command,
          .worker_environment = side.environment};
}

// Throws, and thereby ends the whole comparison, if the device of a side could not be opened for
// its first configuration.
void require_opened(const record::Store& store, const record::Record* record) {
  if (record == nullptr || record->outcome == record::Outcome::measured) return;
  if (store.devices(record->run).empty()) {
    throw record::NotMeasured(record::Outcome::skipped, record->reason);
  }
}

// Returns the variables that select a driver and differ between the sides, if both sides have
// loaded the same version of the same driver nevertheless.
std::vector<std::string> ineffective_variables(const ComparisonOptions& options,
                                               const record::Device& a, const record::Device& b) {
  const bool same_driver = a.id == b.id && a.driver == b.driver &&
                           a.driver_version == b.driver_version && a.api_version == b.api_version;
  if (!same_driver) return {};
  return measure::differing_driver_variables(options.a.environment, options.b.environment);
}

RunSide side_of(const record::Store& store, const measure::RunResult& result) {
  return {store, result.run, store.devices(result.run).at(0).device};
}

ComparisonProgress comparison_progress(const measure::Progress& progress) {
  return {.stage = ComparisonStage::deterministic,
          .configuration = progress.configuration,
          .done = progress.done,
          .total = progress.total,
          .left = progress.left,
          .loading = progress.loading};
}

void choose_clock(const ConfigurationDiff& diff, ComparedConfiguration& compared) {
  const auto [a, b] = diff.device_clock_trusted;
  if (a && b) {
    compared.clock = measure::SideClock::device;
  } else if (!a && !b) {
    compared.wall_clock_cause = WallClockCause::neither_calibrated;
  } else {
    compared.wall_clock_cause =
        a ? WallClockCause::b_not_calibrated : WallClockCause::a_not_calibrated;
  }
}

ComparedConfiguration compared_configuration(const ConfigurationDiff& diff,
                                             const measure::Configuration& configuration) {
  ComparedConfiguration compared{.key = diff.key,
                                 .configuration = configuration,
                                 .ended = diff.ended,
                                 .reason = diff.no_time,
                                 .shift = {},
                                 .work = diff.work,
                                 .differences = diff.differences};
  choose_clock(diff, compared);
  return compared;
}

}  // namespace

ComparisonResult compare(const ComparisonOptions& options, const measure::Suite& suite,
                         record::Store& store, measure::Truths& truths,
                         const OnProgress& on_progress) {
  const measure::Stopwatch stopwatch;
  measure::SidesRun sides{options.plan,
                          suite,
                          {options.a.device, options.b.device},
                          {options_for(options.a, options), options_for(options.b, options)}};
  sides.options[1].faults = options.faults;
  const auto runs = measure::run_sides(sides, store, [&](const measure::Progress& progress) {
    require_opened(store, progress.record);
    if (on_progress) on_progress(comparison_progress(progress));
  });
  const RunSide a = side_of(store, runs[0]);
  const RunSide b = side_of(store, runs[1]);
  const bool same_setup =
      options.a.environment == options.b.environment && options.a.command == options.b.command;
  RunDiff diff = diff_runs(a, b, truths, same_setup);
  ComparisonResult result{
      .a = a.device,
      .b = b.device,
      .timed = options.times && options.plan.timed(),
      .device = std::move(diff.device),
      .environment = {options.a.environment, options.b.environment},
      .clocks = {store.devices(runs[0].run).at(0).clocks, store.devices(runs[1].run).at(0).clocks},
      .ineffective_variables = ineffective_variables(options, a.device, b.device)};
  if (options.a.command != options.b.command) {
    result.programs = {options.a.command.at(0), options.b.command.at(0)};
  }
  std::map<std::string, const measure::Configuration*> by_key;
  for (const measure::Configuration& each : options.plan.configurations) {
    by_key[measure::configuration_key(suite, each)] = &each;
  }
  for (const ConfigurationDiff& each : diff.configurations) {
    result.configurations.push_back(compared_configuration(each, *by_key.at(each.key)));
  }
  if (result.timed) {
    result.other_load = measure_times(options, stopwatch, on_progress, result.configurations);
  }
  result.seconds = stopwatch.seconds();
  return result;
}

}  // namespace triptych::comparison
