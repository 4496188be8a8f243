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

constexpr std::array<std::pair<Verdict, std::string_view>, 7> verdict_names{{
    {Verdict::pass, "pass"},
    {Verdict::improved, "improved"},
    {Verdict::advisory, "advisory"},
    {Verdict::skipped, "skipped"},
    {Verdict::waived, "waived"},
    {Verdict::cannot_judge, "cannot_judge"},
    {Verdict::regression, "regression"},
}};

template <typename Table, typename Value>
std::string_view name_in(const Table& table, Value value) {
  for (const auto& [known, name] : table) {
    if (known == value) return name;
  }
  return "unknown";
}

std::size_t count(const GateResult& result, Verdict verdict) {
  return static_cast<std::size_t>(std::ranges::count(result.findings, verdict, &Finding::verdict));
}

std::string plural(std::size_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

// Neither advice nor an excuse for saying nothing.
bool is_decision(Verdict verdict) {
  return verdict != Verdict::advisory && verdict != Verdict::skipped;
}

// " in image, timing on vulkan:lavapipe": where the findings of one verdict lie.
std::string places(const GateResult& result, Verdict verdict) {
  std::set<std::string_view> checks;
  std::set<std::string_view> devices;
  for (const Finding& finding : result.findings) {
    if (finding.verdict != verdict) continue;
    checks.insert(name_of(finding.check));
    if (!finding.device.empty()) devices.insert(finding.device);
  }
  const std::string where = fmt::format(" in {}", fmt::join(checks, ", "));
  return devices.empty() ? where : where + fmt::format(" on {}", fmt::join(devices, ", "));
}

// "; 96 checks, 4 devices; 2 improved, 3 waived, 12 advisory"
std::string tally(const GateResult& result) {
  std::set<std::string_view> devices;
  for (const Finding& finding : result.findings) {
    if (!finding.device.empty()) devices.insert(finding.device);
  }
  std::string text = fmt::format("{}, {}", plural(result.findings.size(), "check", "checks"),
                                 plural(devices.size(), "device", "devices"));
  std::string rest;
  for (const Verdict verdict :
       {Verdict::improved, Verdict::waived, Verdict::advisory, Verdict::skipped}) {
    const std::size_t n = count(result, verdict);
    if (n > 0) rest += fmt::format("{}{} {}", rest.empty() ? "; " : ", ", n, name_of(verdict));
  }
  return text + rest;
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  return name_in(verdict_names, verdict);
}

std::vector<std::string> GateResult::nothing_decided() const {
  std::set<std::string> decided;
  for (const Finding& finding : findings) {
    if (is_decision(finding.verdict)) decided.insert(finding.device);
  }
  std::vector<std::string> without;
  std::ranges::set_difference(devices, decided, std::back_inserter(without));
  return without;
}

// A gate that decided nothing has not passed, and none that decided nothing of one of its devices.
core::ExitCode GateResult::exit_code() const {
  if (count(*this, Verdict::regression) > 0) return core::ExitCode::regression;
  if (count(*this, Verdict::cannot_judge) > 0) return core::ExitCode::cannot_judge;
  const bool decided = std::ranges::any_of(findings, is_decision, &Finding::verdict);
  return decided && nothing_decided().empty() ? core::ExitCode::pass : core::ExitCode::cannot_judge;
}

std::string GateResult::headline() const {
  const std::size_t regressions = count(*this, Verdict::regression);
  const std::size_t undecided = count(*this, Verdict::cannot_judge);
  std::vector<std::string> parts;
  if (regressions > 0) {
    parts.push_back(plural(regressions, "regression", "regressions") +
                    places(*this, Verdict::regression));
  }
  if (undecided > 0) {
    parts.push_back(plural(undecided, "check", "checks") + " undecided" +
                    places(*this, Verdict::cannot_judge));
  }
  switch (exit_code()) {
    case core::ExitCode::pass:
      return "PASS: " + tally(*this);
    case core::ExitCode::regression:
      return fmt::format("FAIL: {}; {}", fmt::join(parts, "; "), tally(*this));
    default:
      if (parts.empty()) {
        parts.push_back(
            nothing_decided().empty()
                ? "nothing was decided"
                : fmt::format("nothing was decided of {}", fmt::join(nothing_decided(), ", ")));
      }
      return fmt::format("CANNOT JUDGE: {}; {}", fmt::join(parts, "; "), tally(*this));
  }
}

bool RunView::knows_driver(const record::Device& device) const {
  const auto& accepted = baselines.manifest().devices;
  const auto found = accepted.find(device.id);
  return found != accepted.end() && found->second.contains(device.statistics_key());
}

std::string RunView::plan_test(Check check) const {
  std::string test = request.plan;
  std::ranges::replace(test, '/', '.');
  return fmt::format("{}.{}", test, name_of(check));
}

std::string RunView::argument() const {
  return request.argument.empty() ? record::plan_argument(request.plan) : request.argument;
}

std::string RunView::accept_command() const {
  return fmt::format("triptych accept {}{}{} --reason TEXT", core::shell_quoted(argument()),
                     request.store_option, request.baselines_option);
}

Finding finding_about(const record::Record& record, Check check, Verdict verdict,
                      std::string message) {
  Finding finding{check,
                  verdict,
                  record.test_id(name_of(check)),
                  record.device,
                  record.configuration,
                  std::move(message)};
  for (const auto each : std::views::split(record.injected, '+')) {
    if (!each.empty()) finding.injected.emplace_back(each.begin(), each.end());
  }
  if (!record.injected.empty()) finding.message += fmt::format(" [injected: {}]", record.injected);
  return finding;
}

Finding finding_about(const RunView& view, const record::Device& device, Check check,
                      Verdict verdict, std::string message) {
  Finding finding{check, verdict, {}, device.id, {}, std::move(message)};
  for (const record::Record& record : view.records) {
    if (record.device == device.id) finding.test = record.test_id(name_of(check));
  }
  if (finding.test.empty()) finding.test = view.plan_test(check) + "." + device.id;
  return finding;
}

Finding finding_about(const RunView& view, Check check, Verdict verdict, std::string message) {
  return {check, verdict, view.plan_test(check), {}, {}, std::move(message)};
}

std::string examples_of(const std::vector<std::string>& configurations) {
  const auto named = std::min<std::ptrdiff_t>(std::ssize(configurations), 3);
  const std::vector<std::string> first(configurations.begin(), configurations.begin() + named);
  return fmt::format("{} ({}{})", plural(configurations.size(), "configuration", "configurations"),
                     fmt::join(first, "; "), std::ssize(configurations) > named ? "; …" : "");
}

void set_number(Finding& finding, const std::string& name, double value) {
  if (std::isfinite(value)) finding.numbers[name] = value;
}

}  // namespace triptych::judge
