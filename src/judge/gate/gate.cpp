#include "judge/gate/gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "core/glob.hpp"
#include "judge/gate/run_view.hpp"
#include "record/bad_input.hpp"

namespace triptych::judge {
namespace {

constexpr std::size_t named_rows = 3;

bool asked_for(const GateRequest& request, const std::string& device) {
  return request.devices.empty() || core::any_glob_matches(request.devices, device);
}

// Of other data than was accepted, under the same name: no number of it can be held against any.
bool other_data(const Baselines& baselines, const record::Record& record) {
  if (record.data_hash.empty()) return false;
  const std::string accepted = baselines.data_hash(record);
  return !accepted.empty() && accepted != record.data_hash;
}

RunView view_of(const record::Store& store, const std::string& run, const Baselines& baselines,
                const GateRequest& request) {
  RunView view{store, baselines, request, request.checks, {}, {}, {}, {}};
  if (view.checks.empty()) {
    view.checks = {Check::image,  Check::counters,    Check::statistics,
                   Check::timing, Check::correlation, Check::accuracy};
    // Its records have no times and no statistics, and their scores judge their pictures.
    if (request.plan.ends_with("/stress")) view.checks = {Check::counters, Check::stress};
  }
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
    (other_data(baselines, record) ? view.of_other_data : view.measured).push_back(&record);
  }
  // Plans made for it.
  if (request.checks.empty() && !request.plan.ends_with("/correlation")) {
    view.checks.erase(Check::correlation);
  }
  if (request.checks.empty() && !request.plan.ends_with("/accuracy")) {
    view.checks.erase(Check::accuracy);
  }
  return view;
}

// A configuration that this very device, driver and all, has measured before is missed when it is
// skipped.
bool measured_before(const RunView& view, const record::Record& record) {
  return view.baselines.present() &&
         view.baselines.bits(view.device(record), record.configuration).has_value();
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
  if (view.measured.empty() && view.of_other_data.empty()) {
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

// Every device must have a record, of whatever outcome, of every accepted configuration.
void report_missing_rows(const RunView& view, std::vector<Finding>& findings) {
  const std::vector<std::string> accepted = view.baselines.configurations();
  for (const auto& [id, device] : view.devices) {
    std::set<std::string> there;
    for (const record::Record& record : view.records) {
      if (record.device == id) there.insert(record.configuration);
    }
    std::vector<std::string> missing;
    std::ranges::set_difference(accepted, there, std::back_inserter(missing));
    if (missing.empty()) continue;
    const std::size_t named = std::min(missing.size(), named_rows);
    const std::vector<std::string> examples(missing.begin(),
                                            missing.begin() + static_cast<std::ptrdiff_t>(named));
    findings.push_back(finding_about(
        view, device, *view.checks.begin(), Verdict::cannot_judge,
        fmt::format(
            "missing rows: {} of {} accepted configurations have no record ({}{}); finish the "
            "run with triptych run {} --resume",
            missing.size(), accepted.size(), fmt::join(examples, "; "),
            missing.size() > named ? "; …" : "", record::plan_argument(view.request.plan))));
    set_number(findings.back(), "missing", static_cast<double>(missing.size()));
  }
}

void report_other_data(const RunView& view, std::vector<Finding>& findings) {
  for (const record::Record* record : view.of_other_data) {
    findings.push_back(finding_about(
        *record, *view.checks.begin(), Verdict::cannot_judge,
        fmt::format("its data is not what was accepted under this name (content hash {}, accepted "
                    "{}): restore the file and run again, or {}",
                    record->data_hash, view.baselines.data_hash(*record), view.accept_command())));
  }
}

void report_no_baselines(const RunView& view, std::vector<Finding>& findings) {
  findings.push_back(
      finding_about(view, *view.checks.begin(), Verdict::cannot_judge,
                    fmt::format("there are no baselines in {}; make them with {}",
                                view.baselines.folder().string(), view.accept_command())));
}

void append(std::vector<Finding>& findings, std::vector<Finding> more) {
  std::ranges::move(more, std::back_inserter(findings));
}

bool is_of_times(Check check) {
  return check == Check::timing || check == Check::correlation;
}

bool judges_times(const RunView& view) {
  return view.baselines.present() && std::ranges::any_of(view.checks, is_of_times);
}

// All but times. A wrong picture voids its time, so pictures are judged for those too.
WrongImages run_checks_but_of_times(const RunView& view, GateResult& result) {
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
  report_nothing_measured(view, result.run, result.findings);
  report_outcomes(view, result.findings);
  if (view.baselines.present()) {
    report_missing_rows(view, result.findings);
    report_other_data(view, result.findings);
  } else {
    report_no_baselines(view, result.findings);
  }
}

}  // namespace

void sort_findings(std::vector<Finding>& findings) {
  const auto key = [](const Finding& finding) {
    return std::tuple(rank(finding.verdict), std::string_view(finding.device),
                      std::string_view(finding.configuration), finding.check,
                      std::string_view(finding.message));
  };
  std::ranges::stable_sort(findings, {}, key);
}

GateResult judge_run(const record::Store& store, const std::string& run, const Baselines& baselines,
                     const GateRequest& request) {
  const RunView view = view_of(store, run, baselines, request);
  GateResult result{.plan = request.plan, .run = run, .findings = {}};
  report_what_is_there(view, result);
  const WrongImages wrong = run_checks_but_of_times(view, result);
  if (judges_times(view)) {
    if (view.checks.contains(Check::timing)) append(result.findings, check_timings(view, wrong));
    if (view.checks.contains(Check::correlation)) {
      append(result.findings, check_correlations(view, wrong));
    }
  }
  apply_waivers(view, result.findings);
  sort_findings(result.findings);
  return result;
}

}  // namespace triptych::judge
