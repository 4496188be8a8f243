#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "judge/anchor.hpp"
#include "judge/anchor_run.hpp"
#include "judge/drift.hpp"
#include "judge/run_view.hpp"
#include "judge/statistics.hpp"
#include "judge/timing_model.hpp"
#include "judge/work.hpp"

namespace triptych::judge {
namespace {

// The step of a device's clock: no two samples of one configuration lie closer together.
using Resolutions = std::map<std::pair<std::string, std::string_view>, double>;

double smallest_gap(std::vector<double> samples) {
  std::ranges::sort(samples);
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i] > samples[i - 1]) gap = std::min(gap, samples[i] - samples[i - 1]);
  }
  return gap;
}

// What one step of the clock makes of a time, in ln t.
double one_step(double step, double time) {
  return step < time ? -std::log1p(-step / time) : std::numeric_limits<double>::infinity();
}

Resolutions resolutions(const RunView& view) {
  Resolutions result;
  for (const record::Record* record : view.measured) {
    for (const std::string_view clock : {"wall", "device"}) {
      const double gap = smallest_gap(record->time_ns_by(clock));
      if (!std::isfinite(gap)) continue;
      const auto [known, added] = result.try_emplace({record->device, clock}, gap);
      if (!added) known->second = std::min(known->second, gap);
    }
  }
  return result;
}

// A record that can be judged, with what it is judged by.
struct Judged {
  const record::Record* record;
  bool other_code;  // the stored runs' last device code is not the record's
};

Verdict verdict_of(const TimingTest& test, double tolerance) {
  if (test.slower) return Verdict::regression;
  if (test.faster) return Verdict::improved;
  return test.too_noisy(tolerance) ? Verdict::cannot_judge : Verdict::pass;
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
  TimingCheck(const RunView& view, const WrongImages& wrong)
      : view_(view), wrong_(wrong), resolutions_(resolutions(view)) {}

  std::vector<Finding> run() {
    for (const record::Record* record : view_.measured) {
      if (record->untimed()) {
        add(*record, Verdict::skipped, "timings were not measured: the run was untimed");
      } else if (!record->same_as.empty()) {
        report_taken_over(*record);
      } else {
        sort_out(*record);
      }
    }
    call_witnesses();
    const TimingJudgements judgements = judge_timings(cases_);
    excuses_open_ = are_few_open(judgements.cases);
    for (std::size_t i = 0; i < judged_.size(); ++i) report(i, judgements.cases[i]);
    for (const ProgramJudgement& program : judgements.programs) report(program);
    report_shifts(judgements);
    report_drift();
    return std::move(findings_);
  }

 private:
  void add(const record::Record& record, Verdict verdict, std::string message) {
    findings_.push_back(finding_about(record, Check::timing, verdict, std::move(message)));
  }

  // Reports what cannot be judged, keeps the rest for judging together.
  void sort_out(const record::Record& record) {
    const auto wrong = wrong_.find({record.device, record.configuration});
    if (wrong != wrong_.end()) {
      report_wrong_picture(record, wrong->second);
      return;
    }
    const auto stored = view_.baselines.timings(view_.device(record), record.configuration);
    const std::string_view clock = common_clock(record, stored);
    const std::vector<double>& samples = record.time_ns_by(clock);
    const double now = samples.empty() ? 0 : median(samples);
    if (!(now > 0) || !std::isfinite(now)) {
      add(record, Verdict::cannot_judge, "no time was measured; run the plan again");
      return;
    }
    std::map<std::string, double> same_clock;
    std::size_t other_clocks = 0;
    for (const StoredTiming& timing : stored) {
      const auto time = timing.median_by(clock);
      if (!time) ++other_clocks;
      // A run that was accepted is no witness against itself.
      if (time && timing.run != record.run) same_clock[timing.run] = *time;
    }
    if (same_clock.size() + other_clocks < TimingModel::least_runs) {
      report_too_few(record, now, same_clock, other_clocks);
    } else if (same_clock.size() < TimingModel::least_runs) {
      add(record, Verdict::cannot_judge,
          fmt::format("timed by the {} clock, as only {} of {} stored runs are, {} are needed; "
                      "accept anew: {}",
                      clock, same_clock.size(), same_clock.size() + other_clocks,
                      TimingModel::least_runs, view_.accept_command()));
    } else {
      keep(record, clock, now, std::move(same_clock),
           stored.back().kernel_hash != record.kernel_hash);
    }
  }

  // Where the picture is judged as well, or excused, that is the verdict.
  void report_wrong_picture(const record::Record& record, const std::string& why) {
    const bool is_told =
        view_.checks.contains(Check::image) || is_waived(view_, record, Check::image);
    add(record, is_told ? Verdict::skipped : Verdict::cannot_judge,
        "its picture is wrong, so its time means nothing: " + why);
  }

  // Its time is judged where it was measured.
  void report_taken_over(const record::Record& record) {
    add(record, Verdict::skipped,
        fmt::format("its frames are another configuration's, which its scene cannot tell from it "
                    "({})",
                    record.reason));
  }

  void report_too_few(const record::Record& record, double now,
                      const std::map<std::string, double>& stored, std::size_t other_clocks) {
    if (view_.baselines.lost_timings(view_.device(record))) {
      add(record, Verdict::cannot_judge,
          "no stored timings, though the history tells of them; restore them or accept: " +
              view_.accept_command());
      return;
    }
    std::vector<double> logarithms;
    for (const auto& [run, ns] : stored) logarithms.push_back(std::log(ns));
    std::string message = fmt::format("{} stored runs of this device key, {} are needed to judge",
                                      stored.size(), TimingModel::least_runs);
    const double ratio = now / std::exp(mean(logarithms));
    if (other_clocks > 0) message += fmt::format("; {} more are of another clock", other_clocks);
    // The ratio is among the numbers: the message is the same for all configurations.
    message += "; store more with " + view_.accept_command();
    add(record, Verdict::advisory, std::move(message));
    set_number(findings_.back(), "median_ns", now);
    set_number(findings_.back(), "ratio", ratio);
    set_number(findings_.back(), "runs", static_cast<double>(stored.size()));
  }

  void keep(const record::Record& record, std::string_view clock, double now,
            std::map<std::string, double> stored, bool other_code) {
    const auto resolution = resolutions_.find({record.device, clock});
    const double step = resolution == resolutions_.end() ? 0 : resolution->second;
    TimingCase timing;
    timing.device = record.device;
    timing.anchor = is_anchor(record);
    timing.median_ns = now;
    timing.stored_ns = std::move(stored);
    timing.tolerance = std::max(std::log(TimingModel::tolerated), one_step(step, now));
    timing.variance_of_rounds = variance_of_rounds(record.rounds_ns);
    cases_.push_back(std::move(timing));
    judged_.push_back({&record, other_code});
  }

  // The anchors' own plan, where it was measured beside this run and the stored ones.
  void call_witnesses() {
    if (judged_.empty() || view_.request.plan == anchors_plan) return;
    const std::vector<record::Record> anchors = anchors_of(view_);
    if (anchors.empty()) return;
    const Baselines stored = view_.baselines.of_plan(anchors_plan);
    const auto runs = stored_runs();
    for (const record::Record& anchor : anchors) {
      const auto of_device = runs.find(anchor.device);
      if (of_device != runs.end()) call_witness(anchor, stored, of_device->second);
    }
  }

  void call_witness(const record::Record& anchor, const Baselines& baselines,
                    const std::set<std::string>& runs) {
    const auto stored = baselines.timings(view_.device(anchor), anchor.configuration);
    const std::string_view clock = common_clock(anchor, stored);
    if (anchor.time_ns_by(clock).empty()) return;
    std::map<std::string, double> times;
    std::set<std::string> anchor_runs;
    for (const StoredTiming& timing : stored) {
      const auto time = timing.median_by(clock);
      if (!time) continue;
      times[timing.run] = *time;
      anchor_runs.insert(timing.run);
    }
    TimingCase timing{.device = anchor.device,
                      .anchor = true,
                      .witness = true,
                      .median_ns = median(anchor.time_ns_by(clock)),
                      .stored_ns = {},
                      .tolerance = 0};
    for (const std::string& run : runs) {
      const auto beside = anchors_beside(run, anchor_runs);
      if (beside) timing.stored_ns[run] = times.at(*beside);
    }
    if (timing.stored_ns.size() >= TimingModel::least_runs) cases_.push_back(std::move(timing));
  }

  // Of each device, those its configurations are judged by.
  [[nodiscard]] std::map<std::string, std::set<std::string>> stored_runs() const {
    std::map<std::string, std::set<std::string>> runs;
    for (std::size_t i = 0; i < judged_.size(); ++i) {
      for (const auto& [run, ns] : cases_[i].stored_ns) runs[cases_[i].device].insert(run);
    }
    return runs;
  }

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
    const Verdict told = verdict_of(judgement, timing.tolerance);
    const bool open = told == Verdict::cannot_judge;
    const bool excused = open && excuses_open_;
    const Verdict verdict = of_plan(excused ? Verdict::advisory : told);
    const record::Record& record = *judged_[index].record;
    std::string message = fmt::format(
        "{:.4g} ms, {:.4g} ms in {} stored runs: {:+.1f} % ± {:.1f} %, {:.1f} % tolerated, p = "
        "{:.2g}",
        1e-6 * timing.median_ns, 1e-6 * judgement.baseline_ns, timing.stored_ns.size(),
        100 * std::expm1(judgement.log_ratio), 100 * std::expm1(judgement.half_width),
        100 * std::expm1(timing.tolerance),
        judgement.faster ? judgement.p_faster : judgement.p_slower);
    message += judgement.anchors > 0 ? fmt::format(", after {:+.1f} % of the device",
                                                   100 * std::expm1(judgement.shift))
                                     : ", without anchors";
    const auto work =
        work_change(record.counters, view_.baselines, record.configuration, record.device);
    if (judgement.slower || judgement.faster) {
      message += "; " + why_text(work, judgement.log_ratio);
    }
    if (judged_[index].other_code) message += "; the device code changed since";
    if (judgement.runs < TimingModel::least_runs) {
      message += fmt::format(
          "; the device's own speed is known of {} of the stored runs, {} are needed: store runs "
          "with anchors measured beside them, {}",
          judgement.runs, TimingModel::least_runs, view_.accept_command());
    } else if (open) {
      message += "; too much scatter or too coarse a clock to tell: settle it with " +
                 view_.compare_command();
    }
    if (judgement.faster) message += "; keep it with " + view_.accept_command();
    if (verdict != told && !excused) message += "; the device, not the program";
    add(record, verdict, std::move(message));
    add_numbers(findings_.back(), judgement, timing.tolerance);
    set_number(findings_.back(), "median_ns", timing.median_ns);
    set_number(findings_.back(), "baseline_ns", judgement.baseline_ns);
    set_number(findings_.back(), "shift", judgement.shift);
    set_number(findings_.back(), "runs", static_cast<double>(timing.stored_ns.size()));
    if (work) set_number(findings_.back(), "work_ratio", std::exp(work->log_ratio));
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
    const auto runs = stored_runs();  // in the order of time
    for (std::size_t i = 0; i < judged_.size(); ++i) {
      const TimingCase& timing = cases_[i];
      DriftSeries& each =
          series.emplace_back(DriftSeries{.device = timing.device, .log_times = {}});
      for (const std::string& run : runs.at(timing.device)) {
        const auto stored = timing.stored_ns.find(run);
        each.log_times.push_back(stored == timing.stored_ns.end()
                                     ? std::numeric_limits<double>::quiet_NaN()
                                     : std::log(stored->second));
      }
      each.log_times.push_back(std::log(timing.median_ns));
    }
    for (const Drift& drift : find_drift(series)) {
      const std::set<std::string>& stored = runs.at(drift.device);
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
  const WrongImages& wrong_;
  Resolutions resolutions_;
  std::vector<TimingCase> cases_;  // those of judged_, then the witnesses
  std::vector<Judged> judged_;
  bool excuses_open_ = false;  // what noise leaves open is little enough to be advice
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> check_timings(const RunView& view, const WrongImages& wrong) {
  return TimingCheck(view, wrong).run();
}

}  // namespace triptych::judge
