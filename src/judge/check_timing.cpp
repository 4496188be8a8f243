#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "judge/anchor.hpp"
#include "judge/run_view.hpp"
#include "judge/statistics.hpp"
#include "judge/timing_model.hpp"

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
    const double gap = smallest_gap(record->time_ns());
    if (!std::isfinite(gap)) continue;
    const auto [known, added] = result.try_emplace({record->device, record->clock()}, gap);
    if (!added) known->second = std::min(known->second, gap);
  }
  return result;
}

// A record that can be judged, with what it is judged by.
struct Judged {
  const record::Record* record;
  bool other_code;  // the stored runs' last device code is not the record's
};

class TimingCheck {
 public:
  TimingCheck(const RunView& view, const WrongImages& wrong)
      : view_(view), wrong_(wrong), resolutions_(resolutions(view)) {}

  std::vector<Finding> run() {
    for (const record::Record* record : view_.measured) sort_out(*record);
    const std::vector<TimingJudgement> judgements = judge_timings(cases_);
    for (std::size_t i = 0; i < judgements.size(); ++i) report(i, judgements[i]);
    report_shifts(judgements);
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
      add(record, Verdict::cannot_judge,
          "its picture is wrong, so its time means nothing: " + wrong->second);
      return;
    }
    const double now = record.time_ns().empty() ? 0 : median(record.time_ns());
    if (!(now > 0) || !std::isfinite(now)) {
      add(record, Verdict::cannot_judge, "no time was measured; run the plan again");
      return;
    }
    const auto stored = view_.baselines.timings(view_.device(record), record.configuration);
    std::map<std::string, double> same_clock;
    for (const StoredTiming& timing : stored) {
      // A run that was accepted is no witness against itself.
      if (timing.clock == record.clock() && timing.run != record.run) {
        same_clock[timing.run] = timing.median_ns;
      }
    }
    const bool only_other_clocks =
        !stored.empty() && std::ranges::none_of(stored, [&](const StoredTiming& timing) {
          return timing.clock == record.clock();
        });
    if (only_other_clocks) {
      add(record, Verdict::cannot_judge,
          fmt::format("timed by the {} clock, stored by the {} clock; accept anew: {}",
                      record.clock(), stored.back().clock, view_.accept_command()));
    } else if (same_clock.size() < TimingModel::least_runs) {
      report_too_few(record, now, same_clock, stored.empty());
    } else {
      keep(record, now, std::move(same_clock), stored.back().kernel_hash != record.kernel_hash);
    }
  }

  void report_too_few(const record::Record& record, double now,
                      const std::map<std::string, double>& stored, bool nothing_stored) {
    if (nothing_stored && view_.baselines.accepted_before(view_.device(record))) {
      add(record, Verdict::cannot_judge,
          "no stored timings, though this device was accepted before; restore them or accept: " +
              view_.accept_command());
      return;
    }
    std::vector<double> logarithms;
    for (const auto& [run, ns] : stored) logarithms.push_back(std::log(ns));
    std::string message = fmt::format("{} stored runs of this device key, {} are needed to judge",
                                      stored.size(), TimingModel::least_runs);
    const double ratio = now / std::exp(mean(logarithms));
    if (!stored.empty()) message += fmt::format("; now {:.3f} × their mean", ratio);
    add(record, Verdict::advisory, std::move(message));
    set_number(findings_.back(), "median_ns", now);
    set_number(findings_.back(), "ratio", ratio);
    set_number(findings_.back(), "runs", static_cast<double>(stored.size()));
  }

  void keep(const record::Record& record, double now, std::map<std::string, double> stored,
            bool other_code) {
    const auto resolution = resolutions_.find({record.device, record.clock()});
    const double step = resolution == resolutions_.end() ? 0 : resolution->second;
    TimingCase timing;
    timing.device = record.device;
    timing.anchor = is_anchor(record);
    timing.median_ns = now;
    timing.stored_ns = std::move(stored);
    timing.tolerance = std::max(std::log(TimingModel::tolerated), one_step(step, now));
    cases_.push_back(std::move(timing));
    judged_.push_back({&record, other_code});
  }

  void report(std::size_t index, const TimingJudgement& judgement) {
    const TimingCase& timing = cases_[index];
    const bool noisy =
        !judgement.slower && !judgement.faster && judgement.too_noisy(timing.tolerance);
    const Verdict verdict = judgement.slower   ? Verdict::regression
                            : judgement.faster ? Verdict::improved
                            : noisy            ? Verdict::cannot_judge
                                               : Verdict::pass;
    const record::Record& record = *judged_[index].record;
    std::string message = fmt::format(
        "{:.4g} ms, {:.4g} ms in {} stored runs: {:+.1f} % ± {:.1f} %, {:.1f} % tolerated, p = "
        "{:.2g}",
        1e-6 * timing.median_ns, 1e-6 * judgement.baseline_ns, timing.stored_ns.size(),
        100 * std::expm1(judgement.log_ratio), 100 * std::expm1(judgement.half_width),
        100 * std::expm1(timing.tolerance),
        judgement.faster ? judgement.p_faster : judgement.p_slower);
    message += judgement.anchors > 0 ? fmt::format(", after {:+.1f} % of the anchors",
                                                   100 * std::expm1(judgement.shift))
                                     : ", without anchors";
    if (judged_[index].other_code) message += "; the device code changed since";
    if (noisy) {
      message +=
          "; too much scatter or too coarse a clock to tell: settle it with triptych compare " +
          view_.request.plan;
    }
    if (judgement.faster) message += "; keep it with " + view_.accept_command();
    add(record, verdict, std::move(message));
    add_numbers(findings_.back(), timing, judgement);
  }

  static void add_numbers(Finding& finding, const TimingCase& timing,
                          const TimingJudgement& judgement) {
    set_number(finding, "median_ns", timing.median_ns);
    set_number(finding, "baseline_ns", judgement.baseline_ns);
    set_number(finding, "ratio", std::exp(judgement.log_ratio));
    set_number(finding, "shift", judgement.shift);
    set_number(finding, "tolerance", timing.tolerance);
    set_number(finding, "standard_error", judgement.standard_error);
    set_number(finding, "half_width", judgement.half_width);
    set_number(finding, "degrees", judgement.degrees);
    set_number(finding, "t", judgement.t);
    set_number(finding, "p", judgement.p_slower);
    set_number(finding, "runs", static_cast<double>(timing.stored_ns.size()));
  }

  // A device that has become slower as a whole is worth knowing: it was taken out of every answer.
  void report_shifts(const std::vector<TimingJudgement>& judgements) {
    std::set<std::string> reported;
    for (std::size_t i = 0; i < judgements.size(); ++i) {
      const double shift = judgements[i].shift;
      if (std::abs(shift) <= std::log(TimingModel::tolerated)) continue;
      if (!reported.insert(cases_[i].device).second) continue;
      findings_.push_back(finding_about(
          view_, view_.devices.at(cases_[i].device), Check::timing, Verdict::advisory,
          fmt::format(
              "the device itself is {:+.1f} % slower than in its stored runs, by {} anchors; "
              "this was taken out of its other answers",
              100 * std::expm1(shift), judgements[i].anchors)));
      set_number(findings_.back(), "shift", shift);
    }
  }

  const RunView& view_;
  const WrongImages& wrong_;
  Resolutions resolutions_;
  std::vector<TimingCase> cases_;
  std::vector<Judged> judged_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> check_timings(const RunView& view, const WrongImages& wrong) {
  return TimingCheck(view, wrong).run();
}

}  // namespace triptych::judge
