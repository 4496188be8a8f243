// What CTest needs: the list of tests, made when tests are run by asking which devices are here,
// and the command behind each of them. CTest fixtures make each device measure a plan once; the
// checks judge what it left in the store.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "app/arguments.hpp"
#include "app/ctest_check.hpp"
#include "app/listing.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

struct Test {
  std::string name;
  std::vector<std::string> command;  // arguments of triptych
  std::vector<std::string> labels;
  std::vector<std::string> requires_fixtures;
  std::string sets_up;
  std::string lock;
};

// [=[…]=] takes any text as it is.
std::string quoted(const std::vector<std::string>& words, std::string_view separator) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += separator;
    text += "[=[" + word + "]=]";
  }
  return text;
}

std::string as_cmake(const Test& test) {
  std::string text = fmt::format("add_test([=[{}]=] [=[{}]=] {})\n", test.name, own_program(),
                                 quoted(test.command, " "));
  text += fmt::format(
      "set_tests_properties([=[{}]=] PROPERTIES\n  LABELS [=[{}]=] SKIP_RETURN_CODE 77 "
      "TIMEOUT 1800",
      test.name, fmt::join(test.labels, ";"));
  if (!test.requires_fixtures.empty()) {
    text += fmt::format("\n  FIXTURES_REQUIRED [=[{}]=]", fmt::join(test.requires_fixtures, ";"));
  }
  if (!test.sets_up.empty()) text += fmt::format("\n  FIXTURES_SETUP [=[{}]=]", test.sets_up);
  if (!test.lock.empty()) text += fmt::format("\n  RESOURCE_LOCK [=[{}]=]", test.lock);
  return text + ")\n";
}

struct PlanTests {
  std::string suite;
  std::string plan;  // "volume/quick"
  std::string stem;  // "volume.quick"
  fs::path store;
  record::Checks checks;
};

bool is_of_all(record::Check check) {
  return check == record::Check::stress || check == record::Check::correlation;
}

void add_plan(std::vector<Test>& tests, const PlanTests& plan,
              const std::vector<record::Device>& devices) {
  const std::string store = plan.store.string();
  tests.push_back({.name = plan.stem + ".start",
                   .command = {"test-start", "--store", store},
                   .labels = {plan.suite, "device"},
                   .requires_fixtures = {},
                   .sets_up = plan.stem});
  std::vector<std::string> measured;
  for (const record::Device& device : devices) measured.push_back(plan.stem + "." + device.id);
  for (const record::Device& device : devices) {
    const std::string fixture = plan.stem + "." + device.id;
    std::vector<std::string> measure{"test-measure", plan.plan, "--device",
                                     device.id,      "--store", store};
    tests.push_back({.name = plan.stem + ".measure." + device.id,
                     .command = std::move(measure),
                     .labels = {plan.suite, "measure", "device", device.api, device.id},
                     .requires_fixtures = {plan.stem},
                     .sets_up = fixture,
                     .lock = device.id});
    for (const record::Check each : plan.checks) {
      const std::string_view check = record::name_of(each);
      tests.push_back(
          {.name = fmt::format("{}.{}.{}", plan.stem, check, device.id),
           .command = {"test-check", plan.plan, "--check", std::string(check), "--device",
                       device.id, "--store", store},
           .labels = {plan.suite, std::string(check), "device", device.api, device.id},
           // A score says how a device agrees with the others, and so does a line through both.
           .requires_fixtures = is_of_all(each) ? measured : std::vector<std::string>{fixture},
           .sets_up = {},
           .lock = {}});
    }
  }
  if (!plan.checks.contains(record::Check::image)) return;
  tests.push_back({.name = plan.stem + ".agreement",
                   .command = {"test-check", plan.plan, "--check", "image", "--store", store},
                   .labels = {plan.suite, "image", "agreement", "device"},
                   .requires_fixtures = measured,
                   .sets_up = {},
                   .lock = {}});
}

// "volume.quick", also of a file quick.yaml: what test names and file names can hold.
std::string stem_of(const measure::Plan& plan) {
  std::string stem = plan.suite + "." + plan.name.substr(plan.name.find('/') + 1);
  const auto is_kept = [](char c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    return letter || c == '.' || c == '-' || c == '_';
  };
  std::ranges::replace_if(stem, std::not_fn(is_kept), '_');
  return stem;
}

core::ExitCode register_tests(const fs::path& out, const fs::path& folder,
                              const std::vector<std::string>& plans) {
  const Registry registry = make_registry();
  const measure::Listing listing = list_devices(registry);
  std::vector<Test> tests;
  for (const std::string& plan : plans) {
    const measure::Plan loaded = measure::load_plan(plan, {}, registry.find_suite());
    const std::string stem = stem_of(loaded);
    // CTest works in another folder.
    const std::string argument =
        loaded.name.find('/') != std::string::npos ? plan : fs::absolute(plan).string();
    add_plan(tests, {loaded.suite, argument, stem, folder / (stem + ".sqlite"), loaded.checks},
             listing.devices);
  }
  std::string text = "# Made by asking triptych which devices are here.\n";
  for (const Test& test : tests) text += as_cmake(test);
  write_text(out, text);
  return core::ExitCode::pass;
}

core::ExitCode start(const fs::path& store) {
  require_writable(store.parent_path());
  for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(store.string() + suffix);
  return core::ExitCode::pass;
}

}  // namespace

void add_test_commands(Commands& commands) {
  struct Registering {
    std::string out;
    std::string folder;
    std::vector<std::string> plans;
  };
  auto registering = std::make_shared<Registering>();
  CLI::App* tests =
      commands.add("ctest", "Write the CTest file for the devices of this machine", [registering] {
        return register_tests(registering->out, registering->folder, registering->plans);
      });
  tests->add_option("PLAN", registering->plans)->required();
  tests->add_option("--out", registering->out, "The file to write")->required();
  tests->add_option("--folder", registering->folder, "Where stores are kept")->required();

  auto store = std::make_shared<std::string>();
  CLI::App* starting = commands.add("test-start", "Forget what an earlier test run measured",
                                    [store] { return start(*store); });
  starting->add_option("--store", *store)->required();
  starting->group("");

  auto checked = std::make_shared<CheckArguments>();
  CLI::App* checking = commands.add("test-check", "One check as a CTest test",
                                    [checked] { return check_as_test(*checked); });
  checking->add_option("PLAN", checked->plan)->required();
  checking->add_option("--check", checked->check)->required();
  checking->add_option("--device", checked->device);
  checking->add_option("--store", checked->store)->required();
  checking->group("");
}

}  // namespace triptych::app
