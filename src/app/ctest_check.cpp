#include "app/ctest_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "accuracy/image_metrics.hpp"
#include "app/judging.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/truth.hpp"
#include "core/image_io.hpp"
#include "core/quoting.hpp"
#include "judge/gate/gate.hpp"
#include "measure/plan/plan.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

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
    const core::Image image = store.picture(record.image);
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
                  accuracy::difference_image(image, truth.truth, 16));
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

bool has(const judge::GateResult& result, judge::Verdict verdict) {
  return std::ranges::any_of(
      result.findings, [&](const judge::Finding& finding) { return finding.verdict == verdict; });
}

judge::GateResult judge_store(const CheckArguments& arguments, const record::Store& store,
                              Truths& truths) {
  const std::string plan = measure::plan_name(arguments.plan);
  const auto run = store.latest_run(plan);
  if (!run) throw core::NotSupported("nothing was measured");
  judge::GateRequest request = request_of(truths, plan);
  request.checks = {judge::check(arguments.check)};
  if (!arguments.device.empty()) request.devices = {arguments.device};
  return judge_named(store, run->id, default_baselines().string(), request);
}

// Files that are not here are no fault of a device or a driver, whatever it measured when they
// were: what only they keep from being judged is a skip, with the same reason.
void excuse_absent_data(const CheckArguments& arguments, const Registry& registry,
                        const record::Store& store, judge::GateResult& result) {
  if (!has(result, judge::Verdict::cannot_judge)) return;
  std::vector<record::Record> records = store.records(result.run);
  std::erase_if(records, [&](const record::Record& record) {
    return !arguments.device.empty() && record.device != arguments.device;
  });
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

// Findings as text, the worst one's numbers and pictures for CTest's dashboard.
void tell(const CheckArguments& arguments, const record::Store& store, Truths& truths,
          const judge::GateResult& result) {
  for (const judge::Finding& finding : result.findings) {
    if (finding.verdict == judge::Verdict::pass) continue;
    fmt::print("{} {}: {}\n", judge::name_of(finding.verdict),
               core::printable(finding.configuration), core::printable(finding.message));
  }
  if (!result.findings.empty()) {
    const judge::Finding& worst = result.findings.front();
    for (const auto& [name, value] : worst.numbers) print_measurement(name, value);
    if (arguments.check == "image" && !worst.device.empty()) {
      print_pictures(store, result.run, truths, worst);
    }
  }
  fmt::print("{}\n", result.headline());
}

}  // namespace

core::ExitCode check_as_test(const CheckArguments& arguments) {
  const Registry registry = make_registry();
  record::Store store = open_to_judge(arguments.store);
  Truths truths(registry, store);
  judge::GateResult result = judge_store(arguments, store, truths);
  excuse_absent_data(arguments, registry, store, result);
  tell(arguments, store, truths, result);
  if (const auto reason = reason_to_skip(result)) {
    fmt::print("skipped: {}\n", *reason);
    return core::ExitCode::skip;
  }
  return result.exit_code();
}

}  // namespace triptych::app
