#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "judge/gate/correlation_pairs.hpp"
#include "judge/gate/run_view.hpp"
#include "judge/timing/anchor.hpp"
#include "judge/timing/model.hpp"

namespace triptych::judge {
namespace {

using Model = CorrelationModel;

double percent(double effect) {
  return 100 * std::expm1(effect);
}

std::string level_name(const LevelEffect& level) {
  std::string name = fmt::format("{}={}", level.factor, level.level);
  if (!level.aliases.empty()) name += fmt::format(" (= {})", fmt::join(level.aliases, ", "));
  return name;
}

// Id and driver, of a key that goes on with what else times depend on.
std::string id_and_driver(const std::string& key) {
  return key.substr(0, key.find("; API "));
}

bool is_of_another_processor(const CorrelationPair& pair, const RunView& view) {
  const auto processor = [](const std::string& key) {
    const auto at = std::min(key.find("; CPU "), key.find("; GPU "));
    return at == std::string::npos ? std::string() : key.substr(at, key.find(';', at + 1) - at);
  };
  return processor(pair.other_key) != processor(view.devices.at(pair.device).key());
}

// What a person calls the other device.
std::string name_of_other(const CorrelationPair& pair, const RunView& view) {
  if (pair.of_itself) return "its own history";
  return id_and_driver(pair.other_key) +
         (is_of_another_processor(pair, view) ? " on another processor" : "");
}

// The same among several: the driver only where it is not that of this run.
std::string short_name_of_other(const CorrelationPair& pair, const RunView& view) {
  const auto here = view.devices.find(pair.other);
  const std::string name = id_and_driver(pair.other_key);
  const bool same = here != view.devices.end() && id_and_driver(here->second.key()) == name;
  return fmt::format("{} ({}ρ = {:.4f})", same ? pair.other : name,
                     is_of_another_processor(pair, view) ? "another processor, " : "",
                     pair.result.rho);
}

// What is slower by another device, in a few words; empty where nothing is.
std::string slower_text(const Correlation& result) {
  std::vector<std::string> slower;
  for (const LevelEffect& level : result.levels) {
    if (!level.slower || level.standing) continue;
    slower.push_back(fmt::format("{} {:+.1f} %", level_name(level), percent(level.effect)));
  }
  const auto configurations = std::ranges::count_if(
      result.judgements,
      [](const ConfigurationJudgement& each) { return each.slower && !each.standing; });
  if (configurations > 0) {
    slower.push_back(
        fmt::format("{} configuration{}", configurations, configurations == 1 ? "" : "s"));
  }
  if (result.global.slower) slower.emplace_back("the program as a whole");
  return fmt::format("{}", fmt::join(slower, ", "));
}

// Of one device, what all stored ones say that do not decide, in one line: their own character is
// in it as well. Where nothing is slower by any of them there is nothing to say.
class AsideReport {
 public:
  void add(const CorrelationPair& pair, const std::string& other) {
    if (!pair.result.admitted()) {
      refused_.push_back(other);
      return;
    }
    const std::string slower = slower_text(pair.result);
    if (slower.empty()) {
      expected_.push_back(other);
    } else {
      slower_.push_back(fmt::format("by {}: {}", other, slower));
    }
  }

  [[nodiscard]] bool has_news() const { return !slower_.empty(); }

  [[nodiscard]] std::string message() const {
    std::vector<std::string> parts{fmt::format("slower {}", fmt::join(slower_, "; "))};
    if (!expected_.empty())
      parts.push_back(fmt::format("as {} let expect", fmt::join(expected_, ", ")));
    if (!refused_.empty())
      parts.push_back(fmt::format("cannot be judged by {}", fmt::join(refused_, ", ")));
    return fmt::format("beside what decides: {}", fmt::join(parts, "; "));
  }

 private:
  std::vector<std::string> slower_;
  std::vector<std::string> expected_;
  std::vector<std::string> refused_;
};

// A pair that decides, or one that would if it could.
class PairReport {
 public:
  PairReport(const RunView& view, const CorrelationPair& pair, std::vector<Finding>& findings)
      : view_(view),
        pair_(pair),
        result_(pair.result),
        other_(name_of_other(pair, view)),
        findings_(findings) {}

  void run() {
    if (!result_.admitted()) {
      add(Verdict::advisory, fmt::format("cannot be judged by {}: {}; {}", other_,
                                         fmt::join(result_.refusals, "; "), remedy()));
      add_numbers();
      return;
    }
    for (std::size_t i = 0; i < pair_.cases.size(); ++i) report_configuration(i);
    for (const LevelEffect& level : result_.levels) report_level(level);
    report_global();
    if (slower_) return;
    add(is_few() ? Verdict::advisory : Verdict::pass,
        fmt::format("as {} lets expect: {}{}", other_, fit_text(), few_text()));
    add_numbers();
  }

 private:
  void add(Verdict verdict, std::string message) {
    findings_.push_back(finding_about(view_, view_.devices.at(pair_.device), Check::correlation,
                                      verdict, std::move(message)));
  }

  // As with a device's own history, few stored runs advise only, whatever they say: they do not
  // tell how the other device's times scatter from day to day.
  [[nodiscard]] bool is_few() const { return pair_.stored_runs < TimingModel::least_runs; }

  [[nodiscard]] std::string few_text() const {
    if (!is_few()) return {};
    return fmt::format("; advice only: {} of {} stored runs that a verdict needs",
                       pair_.stored_runs, TimingModel::least_runs);
  }

  // What is slower; `what` of the device, with a blank behind it, or nothing.
  void add_slower(const std::string& what, bool decides, std::string message) {
    slower_ = slower_ || decides;
    if (decides) message += few_text();
    add(decides && !is_few() ? Verdict::regression : Verdict::advisory, std::move(message));
    findings_.back().subject = what + "by " + pair_.other_key;
  }

  [[nodiscard]] std::string fit_text() const {
    return fmt::format(
        "{} configurations, {} anchors, r = {:.3f}, ln t_B = {:.3f} + {:.3f} ln t_A{}, residuals "
        "{:.1f} %; one configuration shows from {:+.0f} % on",
        result_.configurations, result_.anchors, result_.r, result_.line.intercept,
        result_.line.slope, which_line(), percent(result_.scale), percent(result_.smallest_effect));
  }

  [[nodiscard]] std::string which_line() const {
    if (result_.line_of_acceptance)
      return " (when this device was accepted; today there is no line)";
    return result_.line_beside.empty() ? "" : fmt::format(" (beside {})", result_.line_beside);
  }

  // What would help depends on what is missing.
  [[nodiscard]] std::string remedy() const {
    if (result_.anchors < Model::least_anchors && pair_.unlike_anchors > 0) {
      return fmt::format(
          "{} more anchors were timed by other kinds of clocks there; accept this device's own "
          "baseline with {}",
          pair_.unlike_anchors, view_.accept_command());
    }
    if (result_.anchors < Model::least_anchors) {
      return fmt::format(
          "measure anchors into the same store with triptych run {0}, and accept them{1} with "
          "triptych accept {0} --reason TEXT",
          anchors_plan, pair_.of_itself ? "" : " on the other device");
    }
    if (result_.configurations < Model::least_configurations) {
      return pair_.unlike_clocks > 0
                 ? fmt::format(
                       "{} more were timed by other kinds of clocks; accept this device's "
                       "own baseline with {}",
                       pair_.unlike_clocks, view_.accept_command())
                 : fmt::format("use a plan with more configurations, or {}",
                               view_.accept_command());
    }
    if (pair_.of_itself) {
      return "compare builds here with " + view_.compare_command();
    }
    return fmt::format(
        "the devices are too unlike; accept this device's own baseline with {}, or "
        "compare builds here with {}",
        view_.accept_command(), view_.compare_command());
  }

  void report_configuration(std::size_t index) {
    const ConfigurationJudgement& judgement = result_.judgements[index];
    if (!judgement.slower) return;
    const CorrelationCase& each = pair_.cases[index];
    add_slower(
        {}, !judgement.standing,
        fmt::format("{:.4g} ms, {:+.1f} % against what {} lets expect, z = {:.1f}, q = {:.2g}, "
                    "{:.0f} % of all deviation; {}",
                    1e-6 * std::exp(each.log_time_b), percent(judgement.residual), other_,
                    judgement.z, judgement.q, 100 * judgement.share,
                    why_text(each.work, judgement.residual)));
    Finding& finding = findings_.back();
    finding.configuration = each.configuration;
    if (judgement.standing) finding.message += "; as when this device was accepted";
    set_number(finding, "median_ns", std::exp(each.log_time_b));
    set_number(finding, "ratio", std::exp(judgement.residual));
    set_number(finding, "z", judgement.z);
    set_number(finding, "p", judgement.p);
    set_number(finding, "q", judgement.q);
    set_number(finding, "share", judgement.share);
    if (each.work) set_number(finding, "work_ratio", std::exp(each.work->log_ratio));
  }

  // A few percent on a level may be how the other device is made: only what is also large decides.
  void report_level(const LevelEffect& level) {
    if (!level.slower) return;
    const bool decides = !level.standing && Model::is_worth_telling(level.effect);
    std::string message = fmt::format(
        "{}: {} configurations {:+.1f} % ± {:.1f} % against the others, as {} lets expect, q = "
        "{:.2g}, {:.0f} % of all deviation",
        level_name(level), level.size, percent(level.effect), percent(level.standard_error), other_,
        level.q, 100 * level.share);
    // A level that holds more than half has the line itself.
    if (result_.line_beside == level.factor + "=" + level.level &&
        2 * level.size <= result_.configurations) {
      message += "; the line is that of the others";
    }
    if (level.standing) {
      message += "; as when this device was accepted";
    } else if (!decides) {
      message +=
          fmt::format("; less than {:.0f} % may be the devices' character: settle it with {}",
                      100 * (Model::least_effect - 1), view_.compare_command());
    }
    add_slower(fmt::format("{}={} ", level.factor, level.level), decides, std::move(message));
    set_number(findings_.back(), "ratio", std::exp(level.effect));
    set_number(findings_.back(), "standard_error", level.standard_error);
    set_number(findings_.back(), "q", level.q);
    set_number(findings_.back(), "share", level.share);
    set_number(findings_.back(), "smallest_effect", level.smallest_effect);
  }

  void report_global() {
    const GlobalShift& global = result_.global;
    if (!global.slower) return;
    const std::string message =
        global.since_acceptance
            ? fmt::format(
                  "the whole program became {:+.1f} % ± {:.1f} % slower since this device "
                  "was accepted (three quarters of its configurations that much or more), beside "
                  "{} anchors",
                  percent(global.delta), percent(global.standard_error), global.groups)
            : fmt::format(
                  "the whole program is {:+.1f} % ± {:.1f} % slower than {} lets expect, "
                  "by {} groups of anchors",
                  percent(global.delta), percent(global.standard_error), other_, global.groups);
    add_slower("program ", true,
               fmt::format("{}, p = {:.2g}: the program, not the device", message, global.p));
    add_numbers();
  }

  void add_numbers() {
    Finding& finding = findings_.back();
    set_number(finding, "configurations", static_cast<double>(result_.configurations));
    set_number(finding, "anchors", static_cast<double>(result_.anchors));
    set_number(finding, "r", result_.r);
    set_number(finding, "rho", result_.rho);
    set_number(finding, "intercept", result_.line.intercept);
    set_number(finding, "slope", result_.line.slope);
    set_number(finding, "scale", result_.scale);
    set_number(finding, "anchor_intercept", result_.anchor_intercept);
    set_number(finding, "smallest_effect", result_.smallest_effect);
    if (result_.global.groups > 1) {
      set_number(finding, "global_delta", result_.global.delta);
      set_number(finding, "global_standard_error", result_.global.standard_error);
      set_number(finding, "global_p", result_.global.p);
      set_number(finding, "global_smallest_effect", result_.global.smallest_effect);
    }
  }

  const RunView& view_;
  const CorrelationPair& pair_;
  const Correlation& result_;
  std::string other_;
  std::vector<Finding>& findings_;
  bool slower_ = false;
};

}  // namespace

CorrelationFindings check_correlations(const RunView& view, const WrongImages& wrong) {
  CorrelationFindings result;
  result.pairs = correlation_pairs(view, wrong);
  std::set<std::string> held;
  std::map<std::string, AsideReport> aside;
  const std::set<std::string> decided = decided_devices(result.pairs);
  for (const CorrelationPair& pair : result.pairs) {
    if (pair.within_run) continue;
    held.insert(pair.device);
    if (is_beside_what_decides(pair, decided)) {
      aside[pair.device].add(pair, short_name_of_other(pair, view));
    } else {
      PairReport(view, pair, result.findings).run();
    }
  }
  for (const auto& [id, report] : aside) {
    if (!report.has_news()) continue;
    result.findings.push_back(finding_about(view, view.devices.at(id), Check::correlation,
                                            Verdict::advisory, report.message()));
    result.findings.back().subject = "by others";
  }
  for (const auto& [id, device] : view.devices) {
    const bool measured = std::ranges::any_of(
        view.measured, [&](const record::Record* record) { return record->device == id; });
    if (!measured || held.contains(id)) continue;
    result.findings.push_back(finding_about(
        view, device, Check::correlation, Verdict::advisory,
        fmt::format("no other device is stored in {}; accept this plan's run of one: {}",
                    view.baselines.folder().string(), view.accept_command())));
  }
  return result;
}

}  // namespace triptych::judge
