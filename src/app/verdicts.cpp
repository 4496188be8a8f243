#include "app/verdicts.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <system_error>
#include <utility>

#include "app/arguments.hpp"
#include "app/ci_system.hpp"
#include "app/paths.hpp"
#include "app/terminal.hpp"
#include "core/foreign_error.hpp"
#include "core/output_files.hpp"
#include "core/quoting.hpp"
#include "measure/plan/plan.hpp"
#include "record/factor_list.hpp"
#include "report/ci/annotations.hpp"
#include "report/ci/folder.hpp"
#include "report/ci/junit.hpp"
#include "report/ci/markdown.hpp"
#include "report/exports/benchmark_json.hpp"
#include "report/overview.hpp"
#include "report/page/page.hpp"
#include "report/screen/summary_screen.hpp"

namespace triptych::app {
namespace {

report::ScreenOptions screen_for(const record::Store& store) {
  report::ScreenOptions options;
  options.store_option = store_option(store.file().string());
  constexpr std::size_t widest = 120;
  if (const std::size_t width = terminal_width(); width > 0)
    options.width = std::min(width, widest);
  options.colours = ::isatty(STDOUT_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr;
  return options;
}

// Returns whether the folder is the folder `baselines` of the working directory.
bool is_own_folder(const std::string& baselines) {
  std::error_code ignored;  // if there is no such folder, it is another one
  return std::filesystem::equivalent(baselines, "baselines", ignored);
}

std::string page_for(const record::Store& store, measure::Truths& truths,
                     const std::vector<judge::GateResult>& results) {
  report::PageRequest request{
      .plans = {}, .truth = [&](const record::Record& record) { return truths.of(record); }};
  const std::vector<record::Run> runs = store.runs();
  for (const judge::GateResult& result : results) {
    const auto run = std::ranges::find(runs, result.run, &record::Run::id);
    request.plans.push_back(
        {.run = run == runs.end() ? record::Run{.plan = result.plan} : *run, .verdict = result});
  }
  return core::with_error_context(store.file().string(),
                                  [&] { return report::page(store, request); });
}

}  // namespace

void require_store(const std::filesystem::path& file) {
  // An empty name is rejected later, when the store is opened.
  if (file.empty() || std::filesystem::exists(file)) return;
  throw core::NotSupported(
      fmt::format("the store {} does not exist; measure first with `triptych run PLAN --store {}`",
                  file.string(), core::shell_quoted(file.string())));
}

record::Store open_to_judge(const std::string& file) {
  require_store(file);
  record::Store store = [&]() -> record::Store {
    try {
      return {file, record::Store::Mode::append};
    } catch (const core::IoError&) {
      return {file, record::Store::Mode::read};
    }
  }();
  store.require_whole();
  return store;
}

std::string latest_run_of(const record::Store& store, const std::string& plan,
                          const std::string& file) {
  const std::string name = measure::plan_name(plan);
  const std::optional<record::Run> run = store.latest_run(name);
  if (run) return run->id;
  throw core::NotSupported(
      fmt::format("{} contains no run of {}; measure first with `triptych run {} --store {}`", file,
                  name, core::shell_quoted(plan), core::shell_quoted(file)));
}

std::string store_option(const std::string& file) {
  return file == default_store ? std::string() : " --store " + core::shell_quoted(file);
}

judge::GateResult judge_stored_run(const record::Store& store, const std::string& run,
                                   const std::string& baselines,
                                   const judge::GateRequest& request) {
  return core::with_error_context(fmt::format("{}: run {}", store.file().string(), run), [&] {
    judge::GateRequest complete = request;
    complete.store_option = store_option(store.file().string());
    const bool other_folder = baselines != default_baselines().string();
    if (other_folder) complete.baselines_option = " --baselines " + core::shell_quoted(baselines);
    judge::GateResult result =
        judge::judge_run(store, run, judge::Baselines(baselines, request.plan), complete);
    if (other_folder) result.baselines = baselines;
    if (std::filesystem::is_directory(baselines) && !is_own_folder(baselines)) {
      result.other_baselines = baselines;
      result.lacks_own_baselines = !other_folder;
    }
    return result;
  });
}

void excuse_absent_data(const record::Store& store, judge::GateResult& result) {
  result.data_excused = true;
  const std::vector<record::Record> records = store.records(result.run);
  for (judge::Finding& finding : result.findings) {
    if (finding.verdict != judge::Verdict::cannot_judge) continue;
    bool any = false;
    bool all_absent = true;
    for (const record::Record& record : records) {
      const bool device = finding.device.empty() || finding.device == record.device;
      const bool configuration =
          finding.configuration.empty() || finding.configuration == record.configuration;
      if (!device || !configuration) continue;
      any = true;
      all_absent = all_absent && record::lacks_data(record.outcome, record.reason);
    }
    if (any && all_absent) finding.verdict = judge::Verdict::skipped;
  }
}

judge::GateRequest request_of(measure::Truths& truths, const std::string& plan) {
  using record::Record;
  return {
      .plan = plan,
      .checks = {},
      .devices = {},
      .required_devices = {},
      .truth = [&truths](const Record& record) { return truths.of(record); },
      .limit = [&truths](const Record& record) { return truths.limit_of(record); },
      .expectations = [&truths](const Record& record) { return truths.expectations_of(record); },
      .open_counts = [&truths](const Record& record) { return truths.open_counts_of(record); },
      .today = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))),
      .data_hash = [&truths](const Record& record) { return truths.data_hash_of(record); }};
}

judge::GateRequest request_of(measure::Truths& truths, const measure::Plan& plan,
                              const measure::Suite& suite) {
  judge::GateRequest request = request_of(truths, plan.name);
  request.argument = plan.argument;
  request.plan_hash = plan.hash;
  for (const measure::Configuration& each : plan.configurations) {
    request.expected.push_back(measure::configuration_key(suite, each));
    const auto named_in_key = record::parse_factor_list(request.expected.back());
    for (const std::string& factor : plan.named) {
      if (!named_in_key.contains(factor)) request.defaults.emplace(factor, each.at(factor));
    }
  }
  return request;
}

std::string page_of(const record::Store& store, measure::Truths& truths,
                    const std::string& baselines) {
  std::vector<judge::GateResult> results;
  for (const record::Run& run : latest_runs(store)) {
    results.push_back(judge_stored_run(store, run.id, baselines, request_of(truths, run.plan)));
  }
  return page_for(store, truths, results);
}

namespace {

report::FindingLocations locations_of(const record::Store& store,
                                      const std::vector<judge::GateResult>& results,
                                      const VerdictFiles& files) {
  report::FindingLocations::Sources sources{.repository = ci_repository(files.ci),
                                            .baselines = files.baselines,
                                            .job = ci_job_file(files.ci)};
  for (const judge::GateResult& result : results) {
    for (const auto& entry : store.devices(result.run)) {
      sources.devices.emplace(entry.device.id, entry.device);
    }
  }
  return report::FindingLocations(std::move(sources));
}

report::JunitFacts junit_facts(const record::Store& store,
                               const std::vector<judge::GateResult>& results,
                               const report::FindingLocations& locations) {
  report::JunitFacts facts{.locations = &locations};
  for (const judge::GateResult& result : results) {
    for (const record::Record& record : store.records(result.run)) {
      const double ns = record.prepare_ns + record.loop_wall_ns + record.overhead_ns;
      facts.seconds[result.plan][{record.device, record.configuration}] = ns / 1e9;
    }
  }
  return facts;
}

// Prints annotations and writes the job summary for GitHub, which does not read them from the
// output folder.
void report_to_ci(const std::vector<judge::GateResult>& results,
                  const report::FindingLocations& locations, CiSystem ci) {
  if (ci != CiSystem::github) return;
  const std::string commands = report::github_annotations(results, locations);
  static_cast<void>(std::fwrite(commands.data(), 1, commands.size(), stderr));
  add_to_job_summary(ci, report::markdown(results));
}

}  // namespace

core::ExitCode report_verdict(const record::Store& store, measure::Truths& truths,
                              const std::vector<judge::GateResult>& results, double seconds,
                              const VerdictFiles& files) {
  const report::FindingLocations locations = locations_of(store, results, files);
  const report::JunitFacts facts = files.junit.empty() && files.folder.empty()
                                       ? report::JunitFacts{}
                                       : junit_facts(store, results, locations);
  if (!files.junit.empty()) core::write_text(files.junit, report::junit(results, facts));
  if (!files.markdown.empty()) core::write_text(files.markdown, report::markdown(results));
  std::vector<std::string> written;
  if (!files.folder.empty()) {
    core::require_writable(files.folder);
    written =
        report::write_folder(files.folder, results,
                             {.page = page_for(store, truths, results),
                              .benchmark = report::benchmark_json(store, latest_runs(store)),
                              .code_quality = files.ci == CiSystem::gitlab
                                                  ? report::gitlab_code_quality(results, locations)
                                                  : std::string(),
                              .junit = facts});
  }
  report_to_ci(results, locations, files.ci);
  if (files.json == "-") {
    fmt::print("{}", report::json(results));
  } else {
    if (!files.json.empty()) core::write_text(files.json, report::json(results));
    fmt::print("{}", report::summary_screen(results, seconds, written, screen_for(store)));
  }
  return report::overview(results).code;
}

}  // namespace triptych::app
