#include "judge/gate/gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "core/glob.hpp"
#include "core/quoting.hpp"
#include "judge/gate/run_view.hpp"
#include "record/bad_input.hpp"

namespace triptych::judge {
namespace {

bool asked_for(const GateRequest& request, const std::string& device) {
  return request.devices.empty() || core::any_glob_matches(request.devices, device);
}

// Why no number of the record can be held against any: it is of other data than was accepted under
// the same name, or than are here now. Empty: it can.
std::string other_data(const RunView& view, const record::Record& record) {
  if (record.data_hash.empty()) return {};
  const std::string accepted =
      view.baselines.present() ? view.baselines.data_hash(record) : std::string();
  if (!accepted.empty() && accepted != record.data_hash) {
    return fmt::format(
        "its data is not what was accepted under this name (content hash {}, "
        "accepted {}): restore the file and run again, or {}",
        record.data_hash, accepted, view.accept_command());
  }
  const std::string now = view.request.data_hash ? view.request.data_hash(record) : std::string();
  if (now.empty() || now == record.data_hash) return {};
  return fmt::format(
      "its data has changed since it was measured (content hash {}, now {}): "
      "restore the file or run again",
      record.data_hash, now);
}

record::Run run_of(const record::Store& store, const std::string& id) {
  for (record::Run& run : store.runs()) {
    if (run.id == id) return std::move(run);
  }
  return {};
}

RunView view_of(const record::Store& store, const std::string& run, const Baselines& baselines,
                const GateRequest& request) {
  RunView view{store, baselines, request, request.checks, {}, {}, {}, {}};
  if (view.checks.empty()) view.checks = checked_in(run_of(store, run));
  for (auto& entry : store.devices(run)) {
    if (asked_for(request, entry.device.id)) view.devices.emplace(entry.device.id, entry.device);
  }
  for (record::Record& record : store.records(run)) {
    if (record.plan != request.plan || !asked_for(request, record.device)) continue;
    // A device the store does not describe matches no stored key.
    record::Device unknown;
    unknown.id = record.device;
    view.devices.try_emplace(record.device, unknown);
    view.records.push_back(std::move(record));
  }
  for (const record::Record& record : view.records) {
    if (record.outcome != record::Outcome::measured) continue;
    (other_data(view, record).empty() ? view.measured : view.of_other_data).push_back(&record);
  }
  return view;
}

// A configuration that this device has measured before is missed when it is skipped. With a setting
// that overrides what the driver can do (MESA_GL_VERSION_OVERRIDE) it is another device.
bool measured_before(const RunView& view, const record::Record& record) {
  const bool overridden = std::ranges::any_of(
      view.device(record).environment,
      [](const auto& setting) { return setting.first.find("OVERRIDE") != std::string::npos; });
  return !overridden && view.baselines.present() &&
         view.baselines.was_measured(record.device, record.configuration);
}

// Everything but measured, once, under the first check asked for. What failed in a stress case is
// told by its score.
void report_outcomes(const RunView& view, std::vector<Finding>& findings) {
  const Check check = *view.checks.begin();
  const bool scored = view.checks.contains(Check::stress);
  for (const record::Record& record : view.records) {
    if (record.outcome == record::Outcome::measured) continue;
    if (scored && record.outcome != record::Outcome::skipped) continue;
    Verdict verdict = Verdict::regression;
    std::string message = fmt::format("{}: {}", name_of(record.outcome), record.reason);
    if (record.outcome == record::Outcome::skipped) {
      const bool missed = measured_before(view, record);
      const bool wanted = missed || record::has_bad_input(record);
      verdict = wanted ? Verdict::cannot_judge : Verdict::skipped;
      if (missed) message += "; the same device measured it when its baselines were accepted";
    }
    findings.push_back(finding_about(record, check, verdict, std::move(message)));
  }
}

void report_nothing_measured(const RunView& view, const std::string& run,
                             std::vector<Finding>& findings) {
  const Check check = *view.checks.begin();
  if (run.empty()) {
    findings.push_back(finding_about(view, check, Verdict::cannot_judge,
                                     "nothing was measured: no run was begun"));
  } else if (view.measured.empty() && view.of_other_data.empty()) {
    findings.push_back(finding_about(
        view, check, Verdict::cannot_judge,
        fmt::format("nothing was measured: run {} holds {} records of {} on the devices asked for",
                    run, view.records.size(), view.request.plan)));
  }
  for (const std::string& glob : view.request.required_devices) {
    const bool there = std::ranges::any_of(view.measured, [&](const record::Record* record) {
      return core::glob_matches(glob, record->device);
    });
    if (there) continue;
    findings.push_back(finding_about(view, check, Verdict::cannot_judge,
                                     fmt::format("the required device {} measured nothing", glob)));
  }
}

std::set<std::string> configurations_of(const RunView& view, const std::string& device) {
  std::set<std::string> there;
  for (const record::Record& record : view.records) {
    if (record.device == device) there.insert(record.configuration);
  }
  return there;
}

void report_missing(const RunView& view, const record::Device& device,
                    const std::set<std::string>& wanted, const std::set<std::string>& there,
                    std::string_view kind, std::vector<Finding>& findings) {
  std::vector<std::string> missing;
  std::ranges::set_difference(wanted, there, std::back_inserter(missing));
  if (missing.empty()) return;
  findings.push_back(finding_about(
      view, device, *view.checks.begin(), Verdict::cannot_judge,
      fmt::format("missing rows: of {} {} configurations there is no record of {}; finish the run "
                  "with triptych run {} --resume{}",
                  wanted.size(), kind, examples_of(missing), core::shell_quoted(view.argument()),
                  view.request.store_option)));
  set_number(findings.back(), "missing", static_cast<double>(missing.size()));
}

// Every device must have a record, of whatever outcome, of every configuration of the plan, of
// every accepted one, and no others.
void report_rows(const RunView& view, std::vector<Finding>& findings) {
  const std::set<std::string> expected(view.request.expected.begin(), view.request.expected.end());
  std::set<std::string> accepted;
  if (view.baselines.present() && !view.request.part) {
    for (std::string& each : view.baselines.configurations()) accepted.insert(std::move(each));
  }
  for (const auto& [id, device] : view.devices) {
    const std::set<std::string> there = configurations_of(view, id);
    report_missing(view, device, expected, there, "planned", findings);
    std::set<std::string> told = there;
    told.insert(expected.begin(), expected.end());
    report_missing(view, device, accepted, told, "accepted", findings);
    std::vector<std::string> extra;
    std::ranges::set_difference(there, expected, std::back_inserter(extra));
    if (expected.empty() || extra.empty()) continue;
    findings.push_back(
        finding_about(view, device, *view.checks.begin(), Verdict::cannot_judge,
                      fmt::format("the plan does not have {}; run it again", examples_of(extra))));
  }
}

// What is judged is what was asked for.
void report_other_plan(const RunView& view, const std::string& run,
                       std::vector<Finding>& findings) {
  if (view.request.plan_hash.empty() || view.records.empty()) return;
  const std::string measured = run_of(view.store, run).plan_hash;
  if (measured == view.request.plan_hash) return;
  findings.push_back(finding_about(
      view, *view.checks.begin(), Verdict::cannot_judge,
      fmt::format(
          "run {} is of another plan than {} is now ({}); run it again", run, view.request.plan,
          measured.empty() ? "it kept no hash"
                           : fmt::format("hash {}, now {}", measured, view.request.plan_hash))));
}

void report_other_data(const RunView& view, std::vector<Finding>& findings) {
  for (const record::Record* record : view.of_other_data) {
    findings.push_back(finding_about(*record, *view.checks.begin(), Verdict::cannot_judge,
                                     other_data(view, *record)));
  }
}

void report_no_baselines(const RunView& view, std::vector<Finding>& findings) {
  const std::string folder = view.baselines.folder().string();
  const std::string& problem = view.baselines.problem();
  findings.push_back(finding_about(
      view, *view.checks.begin(), Verdict::cannot_judge,
      problem.empty() ? fmt::format("there are no baselines in {}; make them with {}", folder,
                                    view.accept_command())
                      : fmt::format("{}: {}: restore it from version control, or start "
                                    "over with {} --drop",
                                    folder, problem, view.accept_command())));
}

void append(std::vector<Finding>& findings, std::vector<Finding> more) {
  std::ranges::move(more, std::back_inserter(findings));
}

bool judges_times(const RunView& view) {
  return view.baselines.present() && view.checks.contains(Check::timing);
}

// All but times. A wrong picture voids its time, so pictures are judged for those too.
WrongImages run_exact_checks(const RunView& view, GateResult& result) {
  std::vector<Finding>& findings = result.findings;
  ImageFindings images;
  const bool wants_images = view.checks.contains(Check::image);
  if (wants_images || (judges_times(view) && view.request.truth)) images = check_images(view);
  if (wants_images) append(findings, std::move(images.findings));
  if (view.checks.contains(Check::accuracy)) {
    AccuracyFindings accuracies = check_accuracies(view);
    append(findings, std::move(accuracies.findings));
    result.accuracies = std::move(accuracies.scenes);
  }
  if (view.checks.contains(Check::stress)) append(findings, check_stress(view));
  if (!view.baselines.present()) return std::move(images.wrong);
  if (view.checks.contains(Check::counters)) append(findings, check_counters(view));
  if (view.checks.contains(Check::statistics)) append(findings, check_statistics(view));
  if (view.checks.contains(Check::cost)) append(findings, check_cost(view));
  if (view.checks.contains(Check::memory)) append(findings, check_memory(view));
  if (view.checks.contains(Check::correlation)) {
    CorrelationFindings correlations = check_correlations(view, images.wrong);
    append(findings, std::move(correlations.findings));
    result.correlations = std::move(correlations.pairs);
  }
  return std::move(images.wrong);
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

void report_what_is_there(const RunView& view, GateResult& result) {
  for (const record::Record* record : view.measured) result.devices.insert(record->device);
  for (const auto& [id, device] : view.devices) result.environments[id] = device.environment;
  report_nothing_measured(view, result.run, result.findings);
  report_outcomes(view, result.findings);
  report_other_plan(view, result.run, result.findings);
  report_rows(view, result.findings);
  report_other_data(view, result.findings);
  if (!view.baselines.present()) report_no_baselines(view, result.findings);
}

// A device that measured and of which all is advice or skips has not passed. Without baselines that
// is said of all of them.
void report_nothing_decided(const RunView& view, GateResult& result) {
  if (!view.request.decides_each_device || !view.baselines.present()) return;
  for (const std::string& device : result.nothing_decided()) {
    result.findings.push_back(finding_about(
        view, view.devices.at(device), *view.checks.begin(), Verdict::cannot_judge,
        fmt::format("nothing was decided of {}: all that is said of it is advice or skips, which "
                    "say why; judge more checks, or accept what is new: {}",
                    device, view.accept_command())));
  }
}

// What was right before, by the program as it is, tells a driver's fault from one of ours.
void tell_where_accepted(const RunView& view, std::vector<Finding>& findings) {
  if (!view.baselines.present()) return;
  for (Finding& each : findings) {
    if (each.verdict != Verdict::regression || each.configuration.empty()) continue;
    const auto device = view.devices.find(each.device);  // there is none of a scene itself
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
  // What changed most is named first; what has no ratio comes by its name.
  const auto change = [](const Finding& finding) {
    const auto ratio = finding.numbers.find("ratio");
    return ratio == finding.numbers.end() ? 0.0 : -std::abs(std::log(ratio->second));
  };
  const auto key = [&](const Finding& finding) {
    return std::tuple(rank(finding.verdict), std::string_view(finding.device), change(finding),
                      std::string_view(finding.configuration), finding.check,
                      std::string_view(finding.message));
  };
  std::ranges::stable_sort(findings, {}, key);
}

GateResult judge_run(const record::Store& store, const std::string& run, const Baselines& baselines,
                     const GateRequest& request) {
  const RunView view = view_of(store, run, baselines, request);
  GateResult result{.plan = request.plan, .run = run, .findings = {}};
  result.argument = request.argument;
  result.defaults = request.defaults;
  result.times_decided = request.times_decide;
  result.part = request.part;
  report_what_is_there(view, result);
  const WrongImages wrong = run_exact_checks(view, result);
  if (judges_times(view)) append(result.findings, check_timings(view, wrong));
  apply_waivers(view, result.findings);
  apply_known(view, result.findings);
  report_nothing_decided(view, result);
  tell_where_accepted(view, result.findings);
  sort_findings(result.findings);
  return result;
}

}  // namespace triptych::judge
