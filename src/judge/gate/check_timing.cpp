#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "judge/baselines/work.hpp"
#include "judge/gate/timing_cases.hpp"
#include "judge/statistics/drift.hpp"
#include "judge/timing/anchor.hpp"

namespace triptych::judge {
namespace {

Verdict verdict_of(const TimingTest& test, double tolerance) {
  if (test.slower) return Verdict::regression;
  if (test.faster) return Verdict::improved;
  return test.too_noisy(tolerance) ? Verdict::cannot_judge : Verdict::pass;
}

std::string sentence(const TimingCase& timing, const TimingJudgement& judgement) {
  const std::string after = judgement.anchors > 0 ? fmt::format("after {:+.1f} % of the device",
                                                                100 * std::expm1(judgement.shift))
                                                  : "without anchors";
  return fmt::format(
      "{:.4g} ms, {:.4g} ms in {} stored runs: {:+.1f} % ± {:.1f} %, {:.1f} % tolerated, p = "
      "{:.2g}, {}",
      1e-6 * timing.median_ns, 1e-6 * judgement.baseline_ns, timing.stored_ns.size(),
      100 * std::expm1(judgement.log_ratio), 100 * std::expm1(judgement.half_width),
      100 * std::expm1(timing.tolerance),
      judgement.faster ? judgement.p_faster : judgement.p_slower, after);
}

// Where anchors and configurations tell the same shift.
std::string witnesses_beside_anchors(const std::vector<ProgramJudgement>& programs,
                                     const std::string& device) {
  const auto own = std::ranges::find(programs, device, &ProgramJudgement::device);
  if (own == programs.end() || own->slower || own->faster) return {};
  return fmt::format(" ({:+.1f} %) and {} configurations", 100 * std::expm1(own->device_shift),
                     own->configurations);
}

class TimingCheck {
 public:
  TimingCheck(const RunView& view, TimingCases collected)
      : view_(view),
        cases_(std::move(collected.cases)),
        judged_(std::move(collected.judged)),
        stored_runs_(std::move(collected.stored_runs)),
        findings_(std::move(collected.findings)) {}

  std::vector<Finding> run() {
    const TimingJudgements judgements = judge_timings(cases_);
    excuses_open_ = are_few_open(judgements.cases);
    for (std::size_t i = 0; i < judged_.size(); ++i) report(i, judgements.cases[i]);
    for (const ProgramJudgement& program : judgements.programs) report(program);
    report_shifts(judgements);
    report_drift();
    return std::move(findings_);
  }

 private:
  // Of a hundred times some are always too noisy to tell; which, is another matter every day.
  [[nodiscard]] bool are_few_open(const std::vector<TimingJudgement>& judgements) const {
    std::size_t open = 0;
    for (std::size_t i = 0; i < judged_.size(); ++i) {
      if (verdict_of(judgements[i], cases_[i].tolerance) != Verdict::cannot_judge) continue;
      if (judgements[i].log_ratio >= std::log(TimingModel::must_be_told)) return false;
      ++open;
    }
    return static_cast<double>(open) <=
           TimingModel::largest_share_open * static_cast<double>(judged_.size());
  }

  void report(std::size_t index, const TimingJudgement& judgement) {
    const TimingCase& timing = cases_[index];
    const JudgedRecord& judged = judged_[index];
    const Verdict told = verdict_of(judgement, timing.tolerance);
    const bool open = told == Verdict::cannot_judge;
    const bool excused = open && excuses_open_;
    const Verdict verdict = of_plan(excused ? Verdict::advisory : told);
    const auto work = work_change(judged.record->counters, view_.baselines,
                                  judged.record->configuration, judged.record->device);
    std::string message = sentence(timing, judgement);
    if (judgement.slower || judgement.faster) {
      message += "; " + why_text(work, judgement.log_ratio);
    }
    if (judged.other_code) message += "; the device code changed since";
    message += what_to_do(judgement, open);
    if (verdict != told && !excused) message += "; the device, not the program";
    findings_.push_back(finding_about(*judged.record, Check::timing, verdict, std::move(message)));
    add_numbers(findings_.back(), judgement, timing.tolerance);
    set_number(findings_.back(), "median_ns", timing.median_ns);
    set_number(findings_.back(), "baseline_ns", judgement.baseline_ns);
    set_number(findings_.back(), "shift", judgement.shift);
    set_number(findings_.back(), "runs", static_cast<double>(timing.stored_ns.size()));
    if (work) set_number(findings_.back(), "work_ratio", std::exp(work->log_ratio));
  }

  [[nodiscard]] std::string what_to_do(const TimingJudgement& judgement, bool open) const {
    std::string text;
    if (judgement.runs < TimingModel::least_runs) {
      text = fmt::format(
          "; the device's own speed is known of {} of the stored runs, {} are needed: store runs "
          "with anchors measured beside them, {}",
          judgement.runs, TimingModel::least_runs, view_.accept_command());
    } else if (open) {
      text = "; too much scatter or too coarse a clock to tell: settle it with " +
             view_.compare_command();
    }
    if (judgement.faster) text += "; keep it with " + view_.accept_command();
    return text;
  }

  // Frozen work that takes longer, or another time in every run, is how the device is today: worth
  // knowing, and no regression of any program.
  [[nodiscard]] Verdict of_plan(Verdict verdict) const {
    const bool of_device = view_.request.plan == anchors_plan;
    const bool fails = verdict == Verdict::regression || verdict == Verdict::cannot_judge;
    return of_device && fails ? Verdict::advisory : verdict;
  }

  static void add_numbers(Finding& finding, const TimingTest& test, double tolerance) {
    set_number(finding, "ratio", std::exp(test.log_ratio));
    set_number(finding, "tolerance", tolerance);
    set_number(finding, "standard_error", test.standard_error);
    set_number(finding, "half_width", test.half_width);
    set_number(finding, "degrees", test.degrees);
    set_number(finding, "t", test.t);
    set_number(finding, "p", test.p_slower);
  }

  // Its configurations together against the anchors.
  void report(const ProgramJudgement& program) {
    const Verdict verdict = verdict_of(program, program.tolerance);
    std::string message = fmt::format(
        "the program as a whole: {:+.1f} % ± {:.1f} % against what {} anchors ({:+.1f} %) allow, "
        "by {} configurations, {:.1f} % tolerated, p = {:.2g}",
        100 * std::expm1(program.log_ratio), 100 * std::expm1(program.half_width), program.anchors,
        100 * std::expm1(program.device_shift), program.configurations,
        100 * std::expm1(program.tolerance), program.faster ? program.p_faster : program.p_slower);
    if (verdict == Verdict::cannot_judge) {
      message +=
          "; the anchors scatter too much to tell: settle it with " + view_.compare_command();
    }
    if (program.faster) message += "; keep it with " + view_.accept_command();
    findings_.push_back(finding_about(view_, view_.devices.at(program.device), Check::timing,
                                      verdict, std::move(message)));
    findings_.back().subject = "program";
    add_numbers(findings_.back(), program, program.tolerance);
    set_number(findings_.back(), "shift", program.device_shift);
  }

  // A device that has become slower as a whole is worth knowing: it was taken out of every answer.
  void report_shifts(const TimingJudgements& judgements) {
    std::set<std::string> reported;
    for (std::size_t i = 0; i < judged_.size(); ++i) {
      const double shift = judgements.cases[i].shift;
      if (std::abs(shift) <= std::log(TimingModel::tolerated)) continue;
      if (!reported.insert(cases_[i].device).second) continue;
      findings_.push_back(finding_about(
          view_, view_.devices.at(cases_[i].device), Check::timing, Verdict::advisory,
          fmt::format("the device itself: {:+.1f} % against its stored runs, by {} anchors{}; this "
                      "was taken out of its other answers",
                      100 * std::expm1(shift), judgements.cases[i].anchors,
                      witnesses_beside_anchors(judgements.programs, cases_[i].device))));
      set_number(findings_.back(), "shift", shift);
    }
  }

  // Every accepted run may have been within the tolerance of those before it.
  void report_drift() {
    std::vector<DriftSeries> series;
    for (std::size_t i = 0; i < judged_.size(); ++i) {
      const TimingCase& timing = cases_[i];
      DriftSeries& each =
          series.emplace_back(DriftSeries{.device = timing.device, .log_times = {}});
      for (const std::string& run : stored_runs_.at(timing.device)) {
        const auto stored = timing.stored_ns.find(run);
        each.log_times.push_back(stored == timing.stored_ns.end()
                                     ? std::numeric_limits<double>::quiet_NaN()
                                     : std::log(stored->second));
      }
      each.log_times.push_back(std::log(timing.median_ns));
    }
    for (const Drift& drift : find_drift(series)) {
      const std::set<std::string>& stored = stored_runs_.at(drift.device);
      report(drift, {stored.begin(), stored.end()});
    }
  }

  // `runs`: the stored ones; the series ends with the one that is judged.
  void report(const Drift& drift, const std::vector<std::string>& runs) {
    const std::size_t at = drift.change.at;
    std::string message = fmt::format(
        "drift: {:+.1f} % since the {}. of {} runs ({}), p = {:.2g}, {}; no single run told it: "
        "look at what was accepted there, and at {}",
        100 * std::expm1(drift.change.effect), at + 1, runs.size() + 1,
        at < runs.size() ? runs[at] : "this one", drift.change.p,
        drift.series ? "against the device's other configurations" : "in all its configurations",
        view_.baselines.folder().string());
    findings_.push_back(drift.series
                            ? finding_about(*judged_[*drift.series].record, Check::timing,
                                            Verdict::advisory, std::move(message))
                            : finding_about(view_, view_.devices.at(drift.device), Check::timing,
                                            Verdict::advisory, std::move(message)));
    findings_.back().subject = "drift";
    set_number(findings_.back(), "ratio", std::exp(drift.change.effect));
    set_number(findings_.back(), "p", drift.change.p);
    set_number(findings_.back(), "since", static_cast<double>(at + 1));
  }

  const RunView& view_;
  std::vector<TimingCase> cases_;  // those of judged_, then the witnesses
  std::vector<JudgedRecord> judged_;
  std::map<std::string, std::set<std::string>> stored_runs_;  // by device
  bool excuses_open_ = false;  // what noise leaves open is little enough to be advice
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> check_timings(const RunView& view, const WrongImages& wrong) {
  return TimingCheck(view, collect_timing_cases(view, wrong)).run();
}

}  // namespace triptych::judge
