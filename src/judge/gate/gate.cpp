#include "judge/gate/gate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "core/glob.hpp"
#include "core/quoting.hpp"
#include "judge/baselines/waiver_values.hpp"
#include "judge/gate/run_view.hpp"
#include "record/driver_variables.hpp"

namespace triptych::judge {
namespace {

bool is_requested_device(const GateRequest& request, const std::string& device) {
  return request.devices.empty() || core::any_glob_matches(request.devices, device);
}

// Returns an observation if the data of the record differ from the data that were accepted under
// the same name, or if the data have changed since the measurement. The numbers of such a record
// are not compared with anything.
std::optional<Observation> other_data(const RunView& view, const record::Record& record) {
  if (record.data_hash.empty()) return std::nullopt;
  const std::string accepted =
      view.baselines.present() ? view.baselines.data_hash(record) : std::string();
  if (!accepted.empty() && accepted != record.data_hash) {
    return Observation{.cause = Cause::other_data,
                       .facts = {{"hash", record.data_hash}, {"accepted", accepted}}};
  }
  const std::string now = view.request.data_hash ? view.request.data_hash(record) : std::string();
  if (now.empty() || now == record.data_hash) return std::nullopt;
  return Observation{.cause = Cause::data_changed,
                     .facts = {{"hash", record.data_hash}, {"now", now}}};
}

record::Run run_of(const record::Store& store, const std::string& id) {
  for (record::Run& run : store.runs()) {
    if (run.id == id) return std::move(run);
  }
  return {};
}

RunView view_of(const record::Store& store, const std::string& run, const Baselines& baselines,
                const GateRequest& request) {
  RunView view{store, baselines, request, run_of(store, run), request.checks, {}, {}, {}, {}};
  if (view.checks.empty()) view.checks = checks_of_run(view.run);
  for (auto& entry : store.devices(run)) {
    if (is_requested_device(request, entry.device.id))
      view.devices.emplace(entry.device.id, entry.device);
  }
  // A device that should have been measured is judged even if the run has no data about it.
  for (const std::string& id : record::devices_of(view.run.begun)) {
    record::Device unknown;
    unknown.id = id;
    if (is_requested_device(request, id)) view.devices.try_emplace(id, unknown);
  }
  for (record::Record& record : store.records(run)) {
    if (record.plan != request.plan || !is_requested_device(request, record.device)) continue;
    // Adds the device if the store does not describe it. In this case, only its id is known, so no
    // baselines match it.
    record::Device unknown;
    unknown.id = record.device;
    view.devices.try_emplace(record.device, unknown);
    view.records.push_back(std::move(record));
  }
  for (const record::Record& record : view.records) {
    if (record.outcome != record::Outcome::measured) continue;
    (other_data(view, record) ? view.with_other_data : view.measured).push_back(&record);
  }
  return view;
}

// Returns whether this skipped configuration was measured on the device when the baselines were
// accepted; the skip then counts as a missing result. Returns false if lacking.json states that
// this driver version does not support the configuration. Also returns false if an environment
// variable such as MESA_GL_VERSION_OVERRIDE changes the capabilities of the driver, because the
// baselines were accepted without this change.
bool measured_before(const RunView& view, const record::Record& record) {
  const bool overridden = std::ranges::any_of(
      view.device(record).environment,
      [](const auto& setting) { return setting.first.find("OVERRIDE") != std::string::npos; });
  if (overridden || !view.baselines.present()) return false;
  if (view.baselines.was_measured(record.device, record.configuration)) {
    return !view.baselines.lacks(view.device(record), record.configuration);
  }
  const DriverCode* code = view.baselines.code(view.device(record));
  return code != nullptr && code->configurations.contains(record.configuration);
}

// Reports each unmeasured record only once, under the first requested check. A stress case (a scene
// on which renderers often fail) that failed is left out, because its score reports the failure.
void report_outcomes(const RunView& view, std::vector<Finding>& findings) {
  const Check check = *view.checks.begin();
  const bool scored = view.checks.contains(Check::stress);
  for (const record::Record& record : view.records) {
    if (record.outcome == record::Outcome::measured) continue;
    if (scored && record.outcome != record::Outcome::skipped) continue;
    const bool skipped = record.outcome == record::Outcome::skipped;
    const bool lost_support = skipped && measured_before(view, record);
    const Verdict verdict = !skipped                                        ? Verdict::regression
                            : lost_support || record::has_bad_input(record) ? Verdict::cannot_judge
                                                                            : Verdict::skipped;
    findings.push_back(
        finding_about(record, check, verdict,
                      {.cause = Cause::ended, .outcome = record.outcome, .reason = record.reason}));
    findings.back().measured_before = lost_support;
  }
}

// Reports driver faults that belong to no configuration: faults of the clock or of the pipeline
// statistics, and crashes or hangs when the device is closed.
void report_device_faults(const RunView& view, std::vector<Finding>& findings) {
  for (const auto& [id, device] : view.devices) {
    for (const record::DeviceFault& fault : device.faults) {
      findings.push_back(finding_about(view, device, *view.checks.begin(), Verdict::regression,
                                       {.cause = Cause::device_fault,
                                        .facts = {{"kind", std::string(name_of(fault.kind))},
                                                  {"subject", fault.subject},
                                                  {"last_words", fault.last_output}},
                                        .detail = fault.detail}));
    }
  }
}

// Reports that the run has no measurement. If a regression of a configuration explains this, such
// as a crash of every configuration, nothing more is reported.
void report_nothing_measured(const RunView& view, const std::string& run,
                             std::vector<Finding>& findings) {
  const bool any_measured = !view.measured.empty() || !view.with_other_data.empty();
  const bool explained = std::ranges::any_of(findings, [](const Finding& finding) {
    return finding.verdict == Verdict::regression && !finding.configuration.empty();
  });
  const Check check = *view.checks.begin();
  if (run.empty()) {
    findings.push_back(finding_about(view, check, Verdict::cannot_judge, {.cause = Cause::no_run},
                                     view.resume_advice()));
  } else if (!any_measured && !explained) {
    findings.push_back(
        finding_about(view, check, Verdict::cannot_judge,
                      {.cause = Cause::nothing_measured,
                       .numbers = {{"records", static_cast<double>(view.records.size())}},
                       .facts = {{"run", run}, {"plan", view.request.plan}}}));
  }
}

// Reports a run that measured another version of the requested plan.
void report_other_plan(const RunView& view, const std::string& run,
                       std::vector<Finding>& findings) {
  if (view.request.plan_hash.empty() || view.records.empty()) return;
  const std::string& measured = view.run.plan_hash;
  if (measured == view.request.plan_hash) return;
  findings.push_back(finding_about(view, *view.checks.begin(), Verdict::cannot_judge,
                                   {.cause = Cause::other_plan,
                                    .facts = {{"run", run},
                                              {"plan", view.request.plan},
                                              {"hash", measured},
                                              {"now", view.request.plan_hash}}},
                                   {Advice::run_again}));
}

void report_other_data(const RunView& view, std::vector<Finding>& findings) {
  for (const record::Record* record : view.with_other_data) {
    Observation observation = other_data(view, *record).value_or(Observation{});
    AdviceWithCommand advice = observation.cause == Cause::other_data
                                   ? view.accept_advice(Advice::restore_data)
                                   : AdviceWithCommand{Advice::restore_or_run_again};
    findings.push_back(finding_about(*record, *view.checks.begin(), Verdict::cannot_judge,
                                     std::move(observation), std::move(advice)));
  }
}

void append(std::vector<Finding>& findings, std::vector<Finding> more) {
  std::ranges::move(more, std::back_inserter(findings));
}

// The input of the checks, and the results, to which each check adds its findings.
struct JudgingState {
  const RunView& view;
  GateResult& result;
  WrongImages wrong = {};
};

// Images are also compared for the check `timing`, because the time of a wrong image is
// meaningless.
void judge_images(JudgingState& state) {
  const bool requested = state.view.checks.contains(Check::image);
  const bool for_times = state.view.baselines.present() && state.view.request.truth &&
                         state.view.checks.contains(Check::timing);
  if (!requested && !for_times) return;
  ImageFindings images = check_images(state.view);
  if (requested) append(state.result.findings, std::move(images.findings));
  state.wrong = std::move(images.wrong);
}

// One row for each check except `image`, in the order in which the checks run. A test requires that
// this table and record::every_check contain the same checks.
struct CheckRow {
  Check check;
  bool needs_baselines;
  void (*judge)(JudgingState&);
};
constexpr std::array check_rows{
    CheckRow{Check::accuracy, false,
             [](JudgingState& state) {
               AccuracyFindings found = check_accuracies(state.view);
               append(state.result.findings, std::move(found.findings));
               state.result.accuracies = std::move(found.scenes);
             }},
    CheckRow{Check::stress, false,
             [](JudgingState& state) { append(state.result.findings, check_stress(state.view)); }},
    CheckRow{
        Check::counters, true,
        [](JudgingState& state) { append(state.result.findings, check_counters(state.view)); }},
    CheckRow{
        Check::statistics, true,
        [](JudgingState& state) { append(state.result.findings, check_statistics(state.view)); }},
    CheckRow{Check::cost, true,
             [](JudgingState& state) { append(state.result.findings, check_cost(state.view)); }},
    CheckRow{Check::code, true,
             [](JudgingState& state) { append(state.result.findings, check_code(state.view)); }},
    CheckRow{Check::memory, true,
             [](JudgingState& state) { append(state.result.findings, check_memory(state.view)); }},
    CheckRow{Check::correlation, true,
             [](JudgingState& state) {
               CorrelationFindings found = check_correlations(state.view, state.wrong);
               append(state.result.findings, std::move(found.findings));
               state.result.correlations = std::move(found.pairs);
             }},
    CheckRow{Check::timing, true,
             [](JudgingState& state) {
               append(state.result.findings, check_timings(state.view, state.wrong));
             }},
};

// Returns the checks that compare with baselines.
std::set<Check> comparing_checks() {
  std::set<Check> checks;
  for (const CheckRow& row : check_rows) {
    if (row.needs_baselines) checks.insert(row.check);
  }
  return checks;
}

void run_checks(JudgingState& state) {
  judge_images(state);
  for (const CheckRow& row : check_rows) {
    const bool possible = !row.needs_baselines || state.view.baselines.present();
    if (possible && state.view.checks.contains(row.check)) row.judge(state);
  }
}

int rank(Verdict verdict) {
  switch (verdict) {
    case Verdict::regression:
      return 0;
    case Verdict::cannot_judge:
      return 1;
    case Verdict::waived:
      return 2;
    case Verdict::improved:
      return 3;
    case Verdict::advisory:
      return 4;
    case Verdict::skipped:
      return 5;
    case Verdict::pass:
      break;
  }
  return 6;
}

// Returns the versions of the programs that measured the run, if one of them is not the program
// that judges it. A run that was resumed may have been measured by several programs.
std::string other_programs(const RunView& view) {
  std::set<std::string> programs;
  for (const record::RunStart& each : view.run.begun) programs.insert(each.program);
  // Older stores contain the version of the program once for each run instead of once for each
  // command that measured a part of the run.
  const bool is_known = programs.erase(std::string()) == 0 && !programs.empty();
  const auto program = view.run.system.find("triptych");
  if (!is_known && program != view.run.system.end()) programs.insert(program->second);
  programs.erase(view.request.program);
  if (programs.empty() || view.request.program.empty()) return {};
  return fmt::format("{}; judged by {}", fmt::join(programs, " and "), view.request.program);
}

void report_run_contents(const RunView& view, GateResult& result) {
  for (const record::Record* record : view.measured) result.devices.insert(record->device);
  for (const auto& [id, device] : view.devices) {
    result.environments[id] = device.environment;
    result.environments[id].merge(record::driver_variables_of(view.run.system, device.api));
  }
  for (const record::RunStart& each : view.run.begun) {
    result.unusable.insert(result.unusable.end(), each.unusable.begin(), each.unusable.end());
  }
  for (const record::Record& record : view.records) {
    if (!record.injected.empty()) ++result.injected[record.injected];
  }
  result.measured_by = other_programs(view);
  const std::string day = view.run.started_at.substr(0, 10);
  if (days_between(day, view.request.today).value_or(0) > 1) result.old_run_date = day;
  report_required_devices(view, result.findings);
  report_outcomes(view, result.findings);
  report_device_faults(view, result.findings);
  report_other_plan(view, result.run, result.findings);
  report_configurations(view, result.findings);
  report_other_data(view, result.findings);
  if (!view.baselines.present()) {
    report_no_baselines(view, comparing_checks(), result.findings);
  }
}

// Reports devices on which something was measured but that have only advisories and skips, because
// such a device must not pass. Without baselines, this would be true for every device, so nothing
// is reported.
void report_undecided_devices(const RunView& view, GateResult& result) {
  if (!view.request.decides_each_device || !view.baselines.present()) return;
  for (const std::string& device : result.undecided_devices()) {
    result.findings.push_back(
        finding_about(view, view.devices.at(device), *view.checks.begin(), Verdict::cannot_judge,
                      {.cause = Cause::nothing_decided}, view.accept_advice(Advice::judge_more)));
  }
}

// Adds to each regression on a new driver version the devices on which its configuration was
// accepted. If the result was correct there, the driver and not Triptych is the likely cause.
void add_accepting_devices(const RunView& view, std::vector<Finding>& findings) {
  if (!view.baselines.present()) return;
  for (Finding& each : findings) {
    if (each.verdict != Verdict::regression || each.configuration.empty()) continue;
    const auto device = view.devices.find(each.device);  // a finding about a scene has no device
    if (device == view.devices.end() || view.knows_driver(device->second)) continue;
    std::set<std::string> devices;
    const auto stored = view.baselines.counters(each.configuration).value_or(StoredCounters{});
    for (const auto& [counter, values] : stored) {
      for (const auto& [id, value] : values) devices.insert(id);
    }
    each.accepted_on.assign(devices.begin(), devices.end());
  }
}

}  // namespace

void sort_findings(std::vector<Finding>& findings) {
  // Findings with a larger change come first. Findings without a ratio count as unchanged, and are
  // sorted by the names of their configurations.
  const auto change = [](const Finding& finding) {
    const auto ratio = finding.numbers.find("ratio");
    return ratio == finding.numbers.end() ? 0.0 : -std::abs(std::log(ratio->second));
  };
  const auto key = [&](const Finding& finding) {
    return std::tuple(rank(finding.verdict), std::string_view(finding.device), change(finding),
                      std::string_view(finding.configuration), finding.check, finding.cause,
                      std::string_view(finding.subject));
  };
  std::ranges::stable_sort(findings, {}, key);
}

std::set<Check> judged_checks() {
  std::set<Check> checks{Check::image};
  for (const CheckRow& row : check_rows) checks.insert(row.check);
  return checks;
}

GateResult judge_run(const record::Store& store, const std::string& run, const Baselines& baselines,
                     const GateRequest& request) {
  const RunView view = view_of(store, run, baselines, request);
  GateResult result{.plan = request.plan, .run = run, .findings = {}};
  result.argument = request.argument;
  result.defaults = request.defaults;
  result.times_decided = request.times_decide;
  result.part = request.part;
  result.checks = view.checks;
  result.tested = tested_devices(view);
  result.waivers_file = baselines.waivers_file().string();
  report_run_contents(view, result);
  report_incomplete_run(view, result.findings);
  JudgingState state{view, result};
  run_checks(state);
  apply_waivers(view, result.findings);
  apply_expected_outcomes(view, result.findings);
  report_nothing_measured(view, run, result.findings);
  report_undecided_devices(view, result);
  add_accepting_devices(view, result.findings);
  sort_findings(result.findings);
  return result;
}

}  // namespace triptych::judge
