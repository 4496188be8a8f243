#include "judge/gate/timing_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "judge/gate/anchor_run.hpp"
#include "judge/statistics/statistics.hpp"
#include "judge/timing/anchor.hpp"

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

class Collection {
 public:
  Collection(const RunView& view, const WrongImages& wrong)
      : view_(view), wrong_(wrong), resolutions_(resolutions(view)) {}

  TimingCases collect() {
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
    return std::move(result_);
  }

 private:
  void add(const record::Record& record, Verdict verdict, std::string message) {
    result_.findings.push_back(finding_about(record, Check::timing, verdict, std::move(message)));
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
    set_number(result_.findings.back(), "median_ns", now);
    set_number(result_.findings.back(), "ratio", ratio);
    set_number(result_.findings.back(), "runs", static_cast<double>(stored.size()));
  }

  void keep(const record::Record& record, std::string_view clock, double now,
            std::map<std::string, double> stored, bool other_code) {
    const auto resolution = resolutions_.find({record.device, clock});
    const double step = resolution == resolutions_.end() ? 0 : resolution->second;
    for (const auto& [run, ns] : stored) result_.stored_runs[record.device].insert(run);
    TimingCase timing;
    timing.device = record.device;
    timing.anchor = is_anchor(record);
    timing.median_ns = now;
    timing.stored_ns = std::move(stored);
    timing.tolerance = std::max(std::log(TimingModel::tolerated), one_step(step, now));
    timing.variance_of_rounds = variance_of_rounds(record.rounds_ns);
    result_.cases.push_back(std::move(timing));
    result_.judged.push_back({&record, other_code});
  }

  // The anchors' own plan, where it was measured beside this run and the stored ones.
  void call_witnesses() {
    if (result_.judged.empty() || view_.request.plan == anchors_plan) return;
    const std::vector<record::Record> anchors = anchors_of(view_);
    if (anchors.empty()) return;
    const Baselines stored = view_.baselines.of_plan(anchors_plan);
    for (const record::Record& anchor : anchors) {
      const auto of_device = result_.stored_runs.find(anchor.device);
      if (of_device != result_.stored_runs.end()) call_witness(anchor, stored, of_device->second);
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
    if (timing.stored_ns.size() >= TimingModel::least_runs)
      result_.cases.push_back(std::move(timing));
  }

  const RunView& view_;
  const WrongImages& wrong_;
  Resolutions resolutions_;
  TimingCases result_;
};

}  // namespace

TimingCases collect_timing_cases(const RunView& view, const WrongImages& wrong) {
  return Collection(view, wrong).collect();
}

}  // namespace triptych::judge
