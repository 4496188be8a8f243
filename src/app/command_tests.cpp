// What CTest needs: the list of tests, made when tests are run by asking which devices are here,
// and the command behind each of them. CTest fixtures make each device measure a plan once; the
// checks judge what it left in the store.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "app/arguments.hpp"
#include "app/listing.hpp"
#include "app/measuring.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/truth.hpp"
#include "core/image_io.hpp"
#include "judge/confirmation.hpp"
#include "judge/gate.hpp"
#include "judge/image_metrics.hpp"
#include "technique/catalogue.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;
constexpr std::array<std::string_view, 4> checks{"image", "counters", "statistics", "timing"};

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
      "TIMEOUT 900",
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
};

// Errors and their orders need no times, whose measuring takes minutes.
bool is_untimed(const PlanTests& plan) {
  return plan.plan.ends_with("/accuracy");
}

// What is judged of a plan. One for correlation is held against other devices; its pictures and
// times are of the kinds that the other plans judge.
std::vector<std::string_view> checks_of(const PlanTests& plan, bool pictures) {
  if (plan.plan.ends_with("/correlation")) return {"correlation"};
  // One frame each: no times, no statistics; a stress case's picture is judged by its score.
  if (plan.plan.ends_with("/stress")) return {"counters", "stress"};
  if (is_untimed(plan)) return {"image", "counters", "accuracy"};
  std::vector<std::string_view> result(checks.begin(), checks.end());
  if (!pictures) std::erase(result, "image");
  return result;
}

// What one launch cannot decide: its suspects are measured again.
bool is_of_times(std::string_view check) {
  return check == "correlation" || check == "timing";
}

bool has_pictures(const std::string& suite) {
  return std::ranges::any_of(technique::catalogue(), [&](const technique::Technique& each) {
    return each.suite == suite && each.picture;
  });
}

void add_plan(std::vector<Test>& tests, const PlanTests& plan,
              const std::vector<record::Device>& devices) {
  const std::string store = plan.store.string();
  tests.push_back({.name = plan.stem + ".start",
                   .command = {"test-start", "--store", store},
                   .labels = {plan.suite, "device"},
                   .requires_fixtures = {},
                   .sets_up = plan.stem});
  const std::vector<std::string_view> own_checks = checks_of(plan, has_pictures(plan.suite));
  std::vector<std::string> measured;
  for (const record::Device& device : devices) measured.push_back(plan.stem + "." + device.id);
  for (const record::Device& device : devices) {
    const std::string fixture = plan.stem + "." + device.id;
    std::vector<std::string> measure{"test-measure", plan.plan, "--device",
                                     device.id,      "--store", store};
    if (is_untimed(plan)) measure.push_back("--untimed");
    tests.push_back({.name = plan.stem + ".measure." + device.id,
                     .command = std::move(measure),
                     .labels = {plan.suite, "measure", "device", device.api, device.id},
                     .requires_fixtures = {plan.stem},
                     .sets_up = fixture,
                     .lock = device.id});
    for (const std::string_view check : own_checks) {
      tests.push_back(
          {.name = fmt::format("{}.{}.{}", plan.stem, check, device.id),
           .command = {"test-check", plan.plan, "--check", std::string(check), "--device",
                       device.id, "--store", store},
           .labels = {plan.suite, std::string(check), "device", device.api, device.id},
           // A score says how a device agrees with the others.
           .requires_fixtures = check == "stress" ? measured : std::vector<std::string>{fixture},
           .sets_up = {},
           .lock = is_of_times(check) ? device.id : std::string()});
    }
  }
  if (std::ranges::find(own_checks, "image") == own_checks.end()) return;
  tests.push_back({.name = plan.stem + ".agreement",
                   .command = {"test-check", plan.plan, "--check", "image", "--store", store},
                   .labels = {plan.suite, "image", "agreement", "device"},
                   .requires_fixtures = measured,
                   .sets_up = {},
                   .lock = {}});
}

core::ExitCode register_tests(const fs::path& out, const fs::path& folder,
                              const std::vector<std::string>& plans) {
  const Registry registry = make_registry();
  const measure::Listing listing = list_devices(registry);
  std::vector<Test> tests;
  for (const std::string& plan : plans) {
    const std::string suite = plan.substr(0, plan.find('/'));
    std::string stem = plan;
    stem.replace(plan.find('/'), 1, ".");
    add_plan(tests, {suite, plan, stem, folder / (stem + ".sqlite")}, listing.devices);
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

struct CheckArguments {
  std::string plan;
  std::string check;
  std::string device;
  std::string store;
};

void print_measurement(std::string_view name, double value) {
  fmt::print("<CTestMeasurement type=\"numeric/double\" name=\"{}\">{}</CTestMeasurement>\n", name,
             value);
}

void print_picture(std::string_view name, const fs::path& file, const core::Image& image) {
  core::write_png(image, file);
  fmt::print("<CTestMeasurementFile type=\"image/png\" name=\"{}\">{}</CTestMeasurementFile>\n",
             name, fs::absolute(file).string());
}

// The three pictures of the worst configuration, beside the store.
void print_pictures(const record::Store& store, const std::string& run, Truths& truths,
                    const judge::Finding& worst) {
  for (const record::Record& record : store.records(run)) {
    if (record.configuration != worst.configuration || record.device != worst.device) continue;
    if (record.image.empty()) return;
    const core::Image image = core::decode_exr(store.image(record.image));
    const judge::TruthPair& truth = truths.of(record);
    const fs::path folder = fs::temp_directory_path();
    std::string stem = worst.test;
    for (char& c : stem) c = c == ':' ? '_' : c;
    const auto file = [&](const char* what) {
      return folder / fmt::format("{}.{}.png", stem, what);
    };
    print_picture("TestImage", file("test"), image);
    print_picture("ValidImage", file("valid"), truth.truth);
    print_picture("DifferenceImage", file("difference"),
                  judge::difference_image(image, truth.truth, 16));
    return;
  }
}

// A check that only advises or skips has judged nothing: a skip with its reason, never a pass.
std::optional<std::string> reason_to_skip(const judge::GateResult& result) {
  std::string reason;
  for (const judge::Finding& finding : result.findings) {
    const bool idle =
        finding.verdict == judge::Verdict::advisory || finding.verdict == judge::Verdict::skipped;
    // A correlation is decided of a device as a whole.
    const bool decided_whole =
        finding.check == judge::Check::correlation &&
        (finding.verdict == judge::Verdict::pass || finding.verdict == judge::Verdict::regression);
    if (decided_whole || (!idle && !finding.configuration.empty())) return std::nullopt;
    if (idle && reason.empty()) reason = finding.message;
  }
  if (reason.empty()) return std::nullopt;
  return reason;
}

struct Checked {
  std::string run;
  judge::GateResult result;
};

Checked judge_store(const CheckArguments& arguments, const record::Store& store, Truths& truths) {
  const auto run = store.latest_run(arguments.plan);
  if (!run) throw core::NotSupported("nothing was measured");
  judge::GateRequest request = request_of(truths, arguments.plan);
  request.checks = {judge::check(arguments.check)};
  if (!arguments.device.empty()) request.devices = {arguments.device};
  return {run->id,
          judge::judge_run(store, run->id, judge::Baselines(default_baselines(), arguments.plan),
                           request)};
}

// Suspects of one launch are measured again on a fresh one, as was decided beforehand.
void confirm_suspects(const CheckArguments& arguments, const Registry& registry,
                      judge::GateResult& result) {
  const std::string fresh = arguments.store + ".confirm." + arguments.device;
  start(fresh);
  if (measure_as_test(arguments.plan, arguments.device, fresh) != core::ExitCode::pass) return;
  record::Store store(fresh, record::Store::Mode::append);
  Truths truths(registry, store);
  judge::take_back_unconfirmed(result, judge_store(arguments, store, truths).result);
}

// Files that are not here are no fault of a device or a driver, whatever it measured when they
// were: what only they keep from being judged is a skip, with the same reason. `records`: of the
// devices that were judged.
void excuse_absent_data(const Registry& registry, const std::vector<record::Record>& records,
                        judge::GateResult& result) {
  const auto absent = [&](const record::Record* record) {
    return record->outcome == record::Outcome::skipped &&
           !registry.find_suite()(record->suite).missing_data(record->factors).empty();
  };
  for (judge::Finding& finding : result.findings) {
    if (finding.verdict != judge::Verdict::cannot_judge) continue;
    std::vector<const record::Record*> about;
    for (const record::Record& record : records) {
      const bool device = finding.device.empty() || finding.device == record.device;
      const bool configuration =
          finding.configuration.empty() || finding.configuration == record.configuration;
      if (device && configuration) about.push_back(&record);
    }
    if (!about.empty() && std::ranges::all_of(about, absent)) {
      finding.verdict = judge::Verdict::skipped;
    }
  }
}

// A slow day fails no test: what was judged and came out as too noisy to tell is advice here, and
// to be settled by `triptych compare`, as its message says. The gate's exit code stays "could not
// judge".
void excuse_noise(judge::GateResult& result) {
  for (judge::Finding& finding : result.findings) {
    const bool noisy = finding.check == judge::Check::timing &&
                       finding.verdict == judge::Verdict::cannot_judge &&
                       finding.numbers.contains("half_width");
    if (noisy) finding.verdict = judge::Verdict::advisory;
  }
}

core::ExitCode check(const CheckArguments& arguments) {
  const Registry registry = make_registry();
  require_store(arguments.store);
  record::Store store(arguments.store, record::Store::Mode::append);
  Truths truths(registry, store);
  auto [run, result] = judge_store(arguments, store, truths);
  const bool undecided = std::ranges::any_of(result.findings, [](const judge::Finding& finding) {
    return finding.verdict == judge::Verdict::cannot_judge;
  });
  if (undecided) {
    std::vector<record::Record> records = store.records(run);
    std::erase_if(records, [&](const record::Record& record) {
      return !arguments.device.empty() && record.device != arguments.device;
    });
    excuse_absent_data(registry, records, result);
  }
  excuse_noise(result);
  if (is_of_times(arguments.check) && !arguments.device.empty() &&
      result.exit_code() == core::ExitCode::regression) {
    confirm_suspects(arguments, registry, result);
  }
  for (const judge::Finding& finding : result.findings) {
    if (finding.verdict == judge::Verdict::pass) continue;
    fmt::print("{} {}: {}\n", judge::name_of(finding.verdict), finding.configuration,
               finding.message);
  }
  if (!result.findings.empty()) {
    const judge::Finding& worst = result.findings.front();
    for (const auto& [name, value] : worst.numbers) print_measurement(name, value);
    if (arguments.check == "image" && !worst.device.empty()) {
      print_pictures(store, run, truths, worst);
    }
  }
  fmt::print("{}\n", result.headline());
  if (const auto reason = reason_to_skip(result)) {
    fmt::print("skipped: {}\n", *reason);
    return core::ExitCode::skip;
  }
  return result.exit_code();
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
                                    [checked] { return check(*checked); });
  checking->add_option("PLAN", checked->plan)->required();
  checking->add_option("--check", checked->check)->required();
  checking->add_option("--device", checked->device);
  checking->add_option("--store", checked->store)->required();
  checking->group("");
}

}  // namespace triptych::app
