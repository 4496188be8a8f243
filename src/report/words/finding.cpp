// Sentences about whole findings and their advice, and the headline that summarizes all findings.

#include "report/words/finding.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "report/words/causes.hpp"

namespace triptych::report::words {
namespace {

using judge::Advice;
using judge::Excuse;
using judge::ExpectedOutcome;
using judge::Finding;
using judge::GateResult;
using judge::RetryResult;
using judge::Verdict;

std::string drawn_again(const Finding& finding) {
  switch (finding.retry_result) {
    case RetryResult::not_drawn:
      break;
    case RetryResult::flake:
      return "flake (correct when drawn again): ";
    case RetryResult::slow:
      return "correct when drawn again, so the device is slow or sometimes hangs: ";
    case RetryResult::other:
      break;
  }
  return {};
}

std::size_t count(const GateResult& result, Verdict verdict) {
  return static_cast<std::size_t>(std::ranges::count(result.findings, verdict, &Finding::verdict));
}

std::string number_of(std::size_t n, std::string_view one, std::string_view many) {
  return counted(static_cast<double>(n), one, many);
}

// Returns the checks and devices that have findings with this verdict: " in image, timing on
// vulkan:lavapipe".
std::string places(const GateResult& result, Verdict verdict) {
  std::set<std::string_view> checks;
  std::set<std::string_view> devices;
  for (const Finding& finding : result.findings) {
    if (finding.verdict != verdict) continue;
    checks.insert(judge::topic_of(finding));
    if (!finding.device.empty()) devices.insert(finding.device);
  }
  const std::string where = fmt::format(" in {}", fmt::join(checks, ", "));
  return devices.empty() ? where : where + fmt::format(" on {}", fmt::join(devices, ", "));
}

// Returns the numbers of findings: "96 checks, 4 devices; 2 improved, 3 waived, 12 advisory".
std::string tally(const GateResult& result) {
  std::set<std::string_view> devices;
  for (const Finding& finding : result.findings) {
    if (!finding.device.empty()) devices.insert(finding.device);
  }
  std::string text = fmt::format("{}, {}", number_of(result.findings.size(), "check", "checks"),
                                 number_of(devices.size(), "device", "devices"));
  std::string rest;
  for (const Verdict verdict :
       {Verdict::improved, Verdict::waived, Verdict::advisory, Verdict::skipped}) {
    const std::size_t n = count(result, verdict);
    if (n > 0)
      rest += fmt::format("{}{} {}", rest.empty() ? "; " : ", ", n, judge::name_of(verdict));
  }
  return text + rest;
}

}  // namespace

std::string excuse(const Finding& finding) {
  const Excuse& excuse = finding.excuse;
  switch (excuse.kind) {
    case Excuse::Kind::waived:
      return fmt::format("waived until {} ({}): ", excuse.expiry, excuse.reason);
    case Excuse::Kind::known:
      return excuse.outcome == ExpectedOutcome::fail
                 ? "known failure: "
                 : fmt::format("known {}: ", judge::name_of(excuse.outcome));
    case Excuse::Kind::unexpected:
      return finding.verdict == Verdict::improved
                 ? fmt::format("passes, although the expectations file lists it as '{}' ({}): ",
                               judge::name_of(excuse.outcome), excuse.reason)
                 : "unexpectedly skipped: ";
    case Excuse::Kind::expired:
    case Excuse::Kind::nothing:
      break;
  }
  return {};
}

std::string found(const Finding& finding) {
  std::string text = drawn_again(finding) + excuse(finding);
  if (!finding.subject.empty()) text += finding.subject + ": ";
  text += text_of(static_cast<const judge::Observation&>(finding));
  if (finding.measured_before) {
    text += "; this configuration was measured on this device when the baselines were accepted";
  }
  if (finding.excuse.kind == Excuse::Kind::expired) {
    text += fmt::format("; its waiver expired on {} ({})", finding.excuse.expiry,
                        finding.excuse.reason);
  }
  for (const judge::Observation& each : finding.retry_observations) {
    text += "; when drawn again: " + text_of(each);
  }
  if (!finding.injected.empty()) {
    text += fmt::format(" [injected: {}]", fmt::join(finding.injected, "+"));
  }
  return text;
}

std::string advice(const Finding& finding) {
  const std::string& command = finding.advice.command;
  switch (finding.advice.advice) {
    case Advice::none:
      break;
    case Advice::accept:
      return "accept the run with " + command;
    case Advice::accept_or_compare:
      return fmt::format(
          "accept this version with {}, or compare two versions directly with gate --base "
          "(docs/gate.md)",
          command);
    case Advice::accept_own:
      return fmt::format(
          "to compare later runs with this one, accept it with {}, and pass the same option "
          "--baselines to `gate` and `report`",
          command);
    case Advice::run_again:
      return "run the plan again";
    case Advice::resume:
      return "finish the run with " + command;
    case Advice::restore_data:
      return fmt::format("restore the data and run the plan again, or accept the run with {}",
                         command);
    case Advice::restore_or_run_again:
      return "restore the data, or run the plan again";
    case Advice::restore_baselines:
      return fmt::format("restore the baselines from version control, or start over with {}",
                         command);
    case Advice::count:
      return "count instructions (requires Valgrind), or leave out the check with --without cost";
    case Advice::judge_more:
      return fmt::format("judge more checks (see --check and --without), or accept the run with {}",
                         command);
    case Advice::more_time:
      return "increase the time limit with --limit";
    case Advice::times:
      return "to let times affect the verdict, use --times";
    case Advice::repair_driver:
      return "repair the driver, or declare the device missing on this machine with " + command;
    case Advice::remove_entry:
      return "remove the entry from the expectations file";
    case Advice::remove_waiver:
      return "remove the waiver";
  }
  return {};
}

std::string driver_text(const judge::TestedDevice& device) {
  if (device.driver.empty() || device.driver_version.empty()) {
    return device.driver + device.driver_version;
  }
  return fmt::format("{} {}", device.driver, device.driver_version);
}

std::string text_of(const Finding& finding) {
  std::string text = found(finding);
  if (const std::string what = advice(finding); !what.empty()) text += "; " + what;
  return text;
}

std::string headline(const GateResult& result) {
  const std::size_t regressions = count(result, Verdict::regression);
  const std::size_t undecided = count(result, Verdict::cannot_judge);
  std::vector<std::string> parts;
  if (regressions > 0) {
    parts.push_back(number_of(regressions, "regression", "regressions") +
                    places(result, Verdict::regression));
  }
  if (undecided > 0) {
    parts.push_back(number_of(undecided, "check", "checks") + " without a verdict" +
                    places(result, Verdict::cannot_judge));
  }
  switch (result.exit_code()) {
    case core::ExitCode::pass:
      return "PASS: " + tally(result);
    case core::ExitCode::regression:
      return fmt::format("FAIL: {}; {}", fmt::join(parts, "; "), tally(result));
    default:
      if (parts.empty()) {
        parts.push_back(result.undecided_devices().empty()
                            ? "no check reached a verdict"
                            : fmt::format("no check reached a verdict on {}",
                                          fmt::join(result.undecided_devices(), ", ")));
      }
      return fmt::format("CANNOT JUDGE: {}; {}", fmt::join(parts, "; "), tally(result));
  }
}

}  // namespace triptych::report::words
