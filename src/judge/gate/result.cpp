#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <ranges>
#include <set>
#include <utility>

#include "core/quoting.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

std::size_t count(const GateResult& result, Verdict verdict) {
  return static_cast<std::size_t>(std::ranges::count(result.findings, verdict, &Finding::verdict));
}

// Returns whether the verdict counts as a decision. Advisories and skips do not.
bool is_decision(Verdict verdict) {
  return verdict != Verdict::advisory && verdict != Verdict::skipped;
}

}  // namespace

std::vector<std::string> GateResult::undecided_devices() const {
  std::set<std::string> decided;
  for (const Finding& finding : findings) {
    if (is_decision(finding.verdict)) decided.insert(finding.device);
  }
  std::vector<std::string> undecided;
  std::ranges::set_difference(devices, decided, std::back_inserter(undecided));
  return undecided;
}

std::map<Check, std::set<std::string>> GateResult::undecided_checks() const {
  // The inner keys are devices. Devices on which the check was only skipped are missing.
  std::map<Check, std::map<std::string, bool>> decided;
  std::set<Check> with_decision;
  for (const Finding& finding : findings) {
    if (is_decision(finding.verdict)) with_decision.insert(finding.check);
    if (finding.device.empty() || finding.verdict == Verdict::skipped) continue;
    bool& is_decided = decided[finding.check][finding.device];
    is_decided = is_decided || is_decision(finding.verdict);
  }
  std::map<Check, std::set<std::string>> undecided;
  for (const Check check : checks) {
    if (!with_decision.contains(check)) {
      undecided[check] = {};
      continue;
    }
    for (const auto& [device, is_decided] : decided[check]) {
      if (!is_decided) undecided[check].insert(device);
    }
  }
  return undecided;
}

// The gate passes only if it reached at least one decision, and at least one for each device.
core::ExitCode GateResult::exit_code() const {
  if (count(*this, Verdict::regression) > 0) return core::ExitCode::regression;
  if (count(*this, Verdict::cannot_judge) > 0) return core::ExitCode::cannot_judge;
  const bool decided = std::ranges::any_of(findings, is_decision, &Finding::verdict);
  return decided && undecided_devices().empty() ? core::ExitCode::pass
                                                : core::ExitCode::cannot_judge;
}

bool RunView::knows_driver(const record::Device& device) const {
  const auto& accepted = baselines.manifest().devices;
  const auto found = accepted.find(device.id);
  return found != accepted.end() && found->second.contains(device.statistics_key());
}

std::string RunView::plan_test_prefix() const {
  std::string prefix = request.plan + ".";
  std::ranges::replace(prefix, '/', '.');
  return prefix;
}

std::string RunView::plan_test_id(Check check) const {
  return fmt::format("{}{}", plan_test_prefix(), name_of(check));
}

std::string RunView::argument() const {
  return request.argument.empty() ? record::plan_argument(request.plan) : request.argument;
}

std::string RunView::today() const {
  return std::max(request.today, run.started_at.substr(0, 10));
}

AdviceWithCommand RunView::accept_advice(Advice advice) const {
  return {advice,
          fmt::format("triptych accept {}{}{} --reason TEXT", core::shell_quoted(argument()),
                      request.store_option, request.baselines_option)};
}

AdviceWithCommand RunView::resume_advice() const {
  const std::string& command = request.resume_command;
  if (!command.empty()) return {Advice::resume, command};
  if (run.id.empty()) return {};  // no run exists that could be resumed
  return {Advice::resume, fmt::format("triptych run {} --resume{}", core::shell_quoted(argument()),
                                      request.store_option)};
}

namespace {

Finding make_finding(Check check, Verdict verdict, Observation observation,
                     AdviceWithCommand advice) {
  Finding result;
  static_cast<Observation&>(result) = std::move(observation);
  result.check = check;
  result.verdict = verdict;
  result.advice = std::move(advice);
  return result;
}

}  // namespace

Finding finding_about(const record::Record& record, Check check, Verdict verdict,
                      Observation observation, AdviceWithCommand advice) {
  Finding result = make_finding(check, verdict, std::move(observation), std::move(advice));
  result.test = record.test_id(name_of(check));
  result.device = record.device;
  result.configuration = record.configuration;
  for (const auto each : std::views::split(record.injected, '+')) {
    if (!each.empty()) result.injected.emplace_back(each.begin(), each.end());
  }
  return result;
}

Finding finding_about(const RunView& view, const record::Device& device, Check check,
                      Verdict verdict, Observation observation, AdviceWithCommand advice) {
  Finding result = make_finding(check, verdict, std::move(observation), std::move(advice));
  result.device = device.id;
  for (const record::Record& record : view.records) {
    if (record.device == device.id) result.test = record.test_id(name_of(check));
  }
  if (result.test.empty()) result.test = view.plan_test_id(check) + "." + device.id;
  return result;
}

Finding finding_about(const RunView& view, Check check, Verdict verdict, Observation observation,
                      AdviceWithCommand advice) {
  Finding result = make_finding(check, verdict, std::move(observation), std::move(advice));
  result.test = view.plan_test_id(check);
  return result;
}

}  // namespace triptych::judge
