// The commands for CTest. At test time, CTest runs `triptych ctest`, which writes the list of tests
// for the devices of this machine. The tests run the hidden commands in this file.

#include <fmt/format.h>

#include <algorithm>

#include "app/arguments.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "app/verdicts.hpp"
#include "core/error.hpp"
#include "core/glob.hpp"
#include "core/output_files.hpp"
#include "measure/worker/own_program.hpp"
#include "report/ci/ctest_list.hpp"
#include "report/ci/ctest_output.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

struct TestsArguments {
  std::vector<std::string> plans;
  std::vector<std::string>
      large;  // plans that are measured on only one of several devices with the same driver
  std::vector<std::string> devices;
  std::string out;
  std::string folder;
};

core::ExitCode list_tests(const TestsArguments& arguments) {
  if (arguments.plans.empty() && arguments.large.empty()) {
    throw core::InputError("no plan is given: add PLAN, or --one-per-driver PLAN");
  }
  const Registry registry = make_registry();
  measure::Listing listing = registry.devices(arguments.devices);
  std::erase_if(listing.devices, [&](const record::Device& device) {
    return !arguments.devices.empty() && !core::any_glob_matches(arguments.devices, device.id);
  });
  std::vector<report::PlanTests> tests;
  const auto add = [&](const std::string& plan, bool one_per_driver) {
    const measure::Plan loaded = measure::load_plan(plan, {}, registry.find_suite());
    const std::string stem = report::ctest_stem(loaded.suite, loaded.name);
    // CTest runs the tests in another folder, so the path of a YAML file must be absolute.
    const bool named = loaded.name.find('/') != std::string::npos;
    tests.push_back({.suite = loaded.suite,
                     .plan = named ? plan : fs::absolute(plan).string(),
                     .stem = stem,
                     .store = (fs::path(arguments.folder) / (stem + ".sqlite")).string(),
                     .checks = loaded.checks,
                     .one_per_driver = one_per_driver});
  };
  for (const std::string& plan : arguments.plans) add(plan, false);
  for (const std::string& plan : arguments.large) add(plan, true);
  core::write_text(arguments.out,
                   report::ctest_list(measure::own_program(), tests, listing.devices));
  return core::ExitCode::pass;
}

core::ExitCode start(const std::string& store) {
  core::require_writable(fs::path(store).parent_path());
  for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(store + suffix);
  return core::ExitCode::pass;
}

struct CheckArguments {
  std::string plan;
  std::string check;   // by name
  std::string device;  // empty: all devices
  std::string store;
};

judge::GateResult judge_store(const CheckArguments& arguments, const record::Store& store,
                              measure::Truths& truths) {
  const std::string plan = measure::plan_name(arguments.plan);
  const auto run = store.latest_run(plan);
  if (!run)
    throw core::NotSupported("the store contains no run of the plan, because nothing was measured");
  judge::GateRequest request = request_of(truths, plan);
  request.checks = {judge::check(arguments.check)};
  request.decides_each_device = false;
  if (!arguments.device.empty()) request.devices = {arguments.device};
  return judge_stored_run(store, run->id, default_baselines().string(), request);
}

// Judges the plan's latest run in the store. The test is skipped if nothing was judged, or if a
// failure is caused by a slow or noisy machine or by a missing file.
core::ExitCode check(const CheckArguments& arguments) {
  const Registry registry = make_registry();
  record::Store store = open_to_judge(arguments.store);
  measure::Truths truths(registry.find_suite(), store);
  judge::GateResult result = judge_store(arguments, store, truths);
  excuse_absent_data(store, result);
  judge::FindTruth find_truth;
  if (arguments.check == "image") {
    find_truth = [&](const record::Record& record) { return truths.of(record); };
  }
  print_lines(report::ctest_output(result, store, find_truth));
  if (const auto reason = report::skip_reason(result)) {
    print_out("skipped: {}\n", *reason);
    return core::ExitCode::skip;
  }
  return result.exit_code();
}

}  // namespace

void add_test_commands(Commands& commands) {
  auto [tests, listed] = commands.add(
      "ctest", "Write a CTest file that tests the devices of this machine", list_tests);
  tests.add_option("PLAN", listed.plans, "Plans to test: YAML files, or SUITE/PLAN");
  tests.add_option("--one-per-driver", listed.large,
                   "Measure this plan on only one device per driver (repeatable)");
  tests.add_option("--device", listed.devices,
                   "Use only devices that match this glob (repeatable)");
  tests.add_option("--out", listed.out, "Write the CTest file to this path")->required();
  tests.add_option("--folder", listed.folder, "Folder to which the tests write their stores")
      ->required();
  add_example(tests, "triptych ctest volume/quick --out tests.cmake --folder stores");

  auto [starting, store] =
      commands.add("test-start", "Delete the measurements of an earlier test run", start);
  starting.add_option("--store", store)->required();
  starting.group("");

  auto [checking, checked] = commands.add("test-check", "Run one check as a CTest test", check);
  checking.add_option("PLAN", checked.plan)->required();
  checking.add_option("--check", checked.check)->required();
  checking.add_option("--device", checked.device);
  checking.add_option("--store", checked.store)->required();
  checking.group("");
}

}  // namespace triptych::app
