// Measures interleaved frame times of the two sides of a comparison (devices, drivers or builds).

#include "comparison/times.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/statistics.hpp"
#include "measure/protocol/injected_fault.hpp"
#include "measure/system/stopwatch.hpp"
#include "measure/system/system_facts.hpp"

namespace triptych::comparison {
namespace {

using measure::Side;
using measure::SideClock;

// A configuration, and the data needed to measure more of its blocks (groups of interleaved
// batches).
struct Entry {
  ComparedConfiguration& compared;
  std::array<std::vector<std::string>, 2> faults;
  std::vector<measure::Block> blocks;             // of the first process run
  std::vector<measure::Block> fresh_blocks = {};  // of all fresh process runs
};

class Timer {
 public:
  Timer(const ComparisonOptions& options, const measure::Stopwatch& since,
        const OnProgress& on_progress, std::vector<ComparedConfiguration>& compared)
      : options_(options),
        on_progress_(on_progress),
        comparison_stopwatch_(since),
        interleaved_({.suite = options.plan.suite,
                      .kinds = measure::work_kinds(options.plan),
                      .limit = options.limit,
                      .seed = options.seed},
                     options.a, options.b) {
    for (ComparedConfiguration& each : compared) {
      if (!each.reason.empty()) continue;  // times would be meaningless
      entries_.push_back({each,
                          {std::vector<std::string>{},
                           measure::faults_for(options_.faults, each.key, options_.b.device)},
                          {}});
    }
  }

  void run() {
    first_looks();
    continue_with_widest();
    confirm_suspects();
    for (Entry& entry : entries_) conclude(entry);
  }

  // Returns ComparisonResult::other_load.
  [[nodiscard]] std::optional<double> mean_load() const {
    if (loads_.empty()) return std::nullopt;
    return estimation::mean(loads_);
  }

 private:
  // Calls `act` for a configuration, and adds the elapsed time to the configuration's total. If the
  // worker of a side dies, only the measurement of this configuration ends.
  template <typename Act>
  void with_stopwatch(Entry& entry, const Act& act) {
    const measure::Stopwatch stopwatch;
    try {
      act();
    } catch (const measure::SideEnded& ended) {
      loaded_ = nullptr;
      entry.compared.ended = ended.outcome();
      entry.compared.reason = {.cause = TimeCause::side_ended,
                               .side = ended.side(),
                               .outcome = ended.outcome(),
                               .reason = ended.reason()};
      const bool fault_of_b =
          ended.side() == Side::b && ended.outcome() != record::Outcome::skipped;
      if (fault_of_b) {
        entry.compared.differences.push_back(
            {.kind = DifferenceKind::regression,
             .subject = Subject::outcome,
             .cause = DifferenceCause::ended,
             .sides = {std::nullopt, judge::Observation{.cause = judge::Cause::ended,
                                                        .outcome = ended.outcome(),
                                                        .reason = ended.reason()}}});
      }
    }
    entry.compared.seconds += stopwatch.seconds();
  }

  void first_looks() {
    int done = 0;
    const int total = static_cast<int>(entries_.size());
    const int first = options_.design.looks.front();
    for (Entry& entry : entries_) {
      const double mean_s = done > 0 ? timing_stopwatch_.seconds() / done : 0;
      report_progress({.stage = ComparisonStage::first_look}, entry, done, total,
                      mean_s * (total - done));
      with_stopwatch(entry, [&] {
        measure_until(entry, first);
        judge_blocks(entry);
      });
      ++done;
    }
  }

  measure::OnLoading loading_callback(const Entry& entry) {
    return [this, &entry](const measure::Loading& loading) {
      if (on_progress_) on_progress_({.configuration = entry.compared.key, .loading = loading});
    };
  }

  void load(Entry& entry) {
    if (loaded_ == &entry) return;
    loaded_ = nullptr;
    interleaved_.hold(entry.compared.configuration, entry.faults, entry.compared.clock,
                      loading_callback(entry));
    entry.compared.frames_per_batch = interleaved_.frames_per_batch();
    loaded_ = &entry;
  }

  void measure_until(Entry& entry, int blocks) {
    load(entry);
    const bool first = entry.blocks.empty();
    while (static_cast<int>(entry.blocks.size()) < blocks && (first || !must_confirm())) {
      entry.blocks.push_back(measure_block());
    }
  }

  measure::Block measure_block() {
    measure::Block block = interleaved_.block();
    // Both workers are idle now, so all threads that are ready to run belong to other programs.
    if (const auto load = measure::other_runnable_threads_per_core()) loads_.push_back(*load);
    return block;
  }

  void judge_blocks(Entry& entry) {
    ComparedConfiguration& compared = entry.compared;
    if (compared.clock == SideClock::device && !measure::device_times_plausible(entry.blocks)) {
      compared.clock = SideClock::wall;
      compared.wall_clock_cause = WallClockCause::implausible;
    }
    const Look look = look_at(measure::differences(entry.blocks, compared.clock), options_.design);
    compared.verdict = look.verdict;
    compared.shift = look.shift;
    compared.blocks = static_cast<int>(entry.blocks.size());
    compared.times = times_of(entry.blocks, compared.clock);
  }

  static std::array<SideTime, 2> times_of(const std::vector<measure::Block>& blocks,
                                          SideClock clock) {
    const auto time = [&](measure::SideTimes measure::Block::*side) {
      std::vector<double> times;
      for (const measure::Block& block : blocks) {
        const measure::SideTimes& of = block.*side;
        const auto& batches = clock == SideClock::device ? of.device_ns.value() : of.wall_ns;
        times.insert(times.end(), batches.begin(), batches.end());
      }
      return record::summarise(times).value_or(SideTime{});
    };
    return {time(&measure::Block::a), time(&measure::Block::b)};
  }

  [[nodiscard]] bool is_over_budget() const {
    return options_.budget && comparison_stopwatch_.elapsed() >= *options_.budget;
  }

  // Returns the minimum time needed to confirm the current suspects (configurations that seem
  // slower or faster) in fresh process runs, that is, with new worker processes.
  [[nodiscard]] double confirmation_s() const {
    double seconds = 0;
    for (const Entry& entry : entries_) {
      const ComparedConfiguration& compared = entry.compared;
      const bool suspected =
          compared.verdict == PairVerdict::slower || compared.verdict == PairVerdict::faster;
      if (!suspected || compared.ended || compared.blocks == 0) continue;
      seconds += compared.seconds / compared.blocks *
                 static_cast<double>(options_.confirmation.blocks_per_process_run) *
                 min_process_runs;
    }
    return seconds;
  }

  // Returns whether measuring more blocks would use up the time needed for the confirmation.
  [[nodiscard]] bool must_confirm() const {
    return options_.budget && comparison_stopwatch_.seconds() + confirmation_s() >=
                                  std::chrono::duration<double>(*options_.budget).count();
  }

  [[nodiscard]] bool can_continue(const Entry& entry) const {
    const ComparedConfiguration& compared = entry.compared;
    return !compared.ended && compared.reason.empty() &&
           compared.verdict == PairVerdict::undecided &&
           options_.design.next_look(compared.blocks) > 0;
  }

  // Returns an upper limit for the remaining time: the time for all blocks that could still be
  // requested, or the remaining budget if that is less.
  [[nodiscard]] double max_remaining_s() const {
    double left = 0;
    for (const Entry& entry : entries_) {
      if (!can_continue(entry)) continue;
      left += entry.compared.seconds / entry.compared.blocks *
              (options_.design.looks.back() - entry.compared.blocks);
    }
    if (!options_.budget) return left;
    return std::min(left, std::chrono::duration<double>(*options_.budget).count() -
                              comparison_stopwatch_.seconds());
  }

  void continue_with_widest() {
    while (!must_confirm()) {
      Entry* widest = nullptr;
      int open = 0;
      for (Entry& entry : entries_) {
        if (!can_continue(entry)) continue;
        ++open;
        const auto width = [](const Entry& each) {
          return each.compared.shift.interval.half_width();
        };
        if (widest == nullptr || width(entry) > width(*widest)) widest = &entry;
      }
      if (widest == nullptr) return;
      const int total = static_cast<int>(entries_.size());
      report_progress({.stage = ComparisonStage::more_blocks}, *widest, total - open, total,
                      max_remaining_s());
      with_stopwatch(*widest, [&] {
        // If the budget ends too early, measure_until() measures fewer blocks than planned.
        // judge_blocks() then evaluates the blocks that were measured.
        measure_until(*widest, options_.design.next_look(widest->compared.blocks));
        judge_blocks(*widest);
      });
    }
  }

  [[nodiscard]] std::vector<Entry*> suspects() {
    std::vector<Entry*> result;
    for (Entry& entry : entries_) {
      const PairVerdict verdict = entry.compared.verdict;
      const bool suspected = verdict == PairVerdict::slower || verdict == PairVerdict::faster;
      if (suspected && !entry.compared.ended) result.push_back(&entry);
    }
    return result;
  }

  void confirm_suspects() {
    const std::vector<Entry*> suspected = suspects();
    if (suspected.empty()) return;
    std::vector<Suspect> fresh;
    for (const Entry* entry : suspected) {
      fresh.push_back({{}, entry->compared.verdict == PairVerdict::slower});
    }
    const measure::Stopwatch stopwatch;
    int done = 0;
    const auto process_run = [&](std::span<const std::size_t> open, std::size_t number,
                                 std::size_t until) {
      const bool enough = number > min_process_runs && is_over_budget();
      const bool all_ended = std::ranges::all_of(
          open, [&](std::size_t i) { return suspected[i]->compared.ended.has_value(); });
      if (enough || all_ended || !restart_workers()) return false;
      const auto left = static_cast<int>((until - number + 1) * open.size());
      const int total = done + left;
      for (const std::size_t i : open) {
        const double mean_s = done > 0 ? stopwatch.seconds() / done : 0;
        report_progress({.stage = ComparisonStage::fresh_process_runs,
                         .process_run = number,
                         .process_runs = until},
                        *suspected[i], done, total, mean_s * (total - done));
        run_again(*suspected[i], fresh[i]);
        ++done;
      }
      return true;
    };
    const auto confirmed =
        confirm_in_looks(fresh, options_.confirmation, options_.design, process_run);
    for (std::size_t i = 0; i < suspected.size(); ++i) {
      if (!suspected[i]->compared.ended) apply_confirmation(confirmed[i], fresh[i], *suspected[i]);
    }
  }

  // Starts new workers for both sides. Returns whether fresh process runs can be measured.
  bool restart_workers() {
    loaded_ = nullptr;
    try {
      interleaved_.restart();
      return true;
    } catch (const measure::SideEnded&) {
      return false;
    }
  }

  void run_again(Entry& entry, Suspect& suspect) {
    if (entry.compared.ended) return;
    with_stopwatch(entry, [&] {
      load(entry);
      std::vector<measure::Block> blocks;
      while (blocks.size() < options_.confirmation.blocks_per_process_run) {
        blocks.push_back(measure_block());
      }
      if (entry.compared.clock == SideClock::device && !measure::device_times_plausible(blocks))
        return;
      const auto differences = measure::differences(blocks, entry.compared.clock);
      const double level = options_.design.alpha_of_a_look();
      suspect.process_runs.push_back(estimate_shift(differences, level).estimate);
      entry.fresh_blocks.insert(entry.fresh_blocks.end(), blocks.begin(), blocks.end());
    });
  }

  void apply_confirmation(const Confirmation& confirmed, const Suspect& suspect, Entry& entry) {
    ComparedConfiguration& compared = entry.compared;
    const auto suspected = std::exchange(compared.verdict, confirmed.verdict);
    if (suspect.process_runs.size() < min_process_runs) {
      compared.reason = {.cause = TimeCause::no_fresh_process_runs, .suspected = suspected};
      return;
    }
    compared.process_runs = static_cast<int>(suspect.process_runs.size());
    if (confirmed.verdict != suspected) {
      compared.reason = {.cause = TimeCause::not_confirmed,
                         .suspected = suspected,
                         .numbers = {{"ratio", std::exp(compared.shift.estimate)},
                                     {"process_runs", static_cast<double>(compared.process_runs)}}};
      compared.out_of_budget = confirmed.verdict == PairVerdict::undecided && options_.budget &&
                               suspect.process_runs.size() < options_.confirmation.looks.back();
    }
    // The times, the shift and its interval must come from the same measurements.
    compared.shift = confirmed.shift;
    compared.times = times_of(entry.fresh_blocks, compared.clock);
  }

  void conclude(Entry& entry) {
    ComparedConfiguration& compared = entry.compared;
    if (compared.blocks == 0) compared.work.reset();
    const bool unexplained = !compared.ended && compared.reason.empty();
    if (unexplained && compared.verdict == PairVerdict::undecided) {
      const bool all = options_.design.next_look(compared.blocks) == 0;
      compared.out_of_budget = !all;
      compared.reason = {.cause = all ? TimeCause::undecided : TimeCause::budget_ended,
                         .numbers = {{"blocks", static_cast<double>(compared.blocks)}}};
    }
    if (compared.reason.empty() || !compared.has_time()) return;
    const Interval& interval = compared.shift.interval;
    if (compared.verdict != PairVerdict::undecided || !std::isfinite(interval.half_width())) return;
    compared.reason.numbers["half_width"] = interval.half_width();
    compared.reason.numbers["most"] = std::max(std::abs(interval.low), std::abs(interval.high));
  }

  void report_progress(ComparisonProgress progress, const Entry& entry, int done, int total,
                       double left_s) {
    if (!on_progress_) return;
    progress.configuration = entry.compared.key;
    progress.done = done;
    progress.total = total;
    progress.left = std::chrono::seconds(static_cast<long>(std::ceil(std::max(0.0, left_s))));
    on_progress_(progress);
  }

  const ComparisonOptions& options_;
  const OnProgress& on_progress_;
  // Measure from the start of the whole comparison, and from the start of the first timing block.
  const measure::Stopwatch& comparison_stopwatch_;
  measure::Stopwatch timing_stopwatch_;
  measure::Interleaved interleaved_;
  std::vector<Entry> entries_;
  std::vector<double> loads_;      // one sample of the machine's load after each block
  const Entry* loaded_ = nullptr;  // the configuration that both workers have loaded
};

}  // namespace

std::optional<double> measure_times(const ComparisonOptions& options,
                                    const measure::Stopwatch& since, const OnProgress& on_progress,
                                    std::vector<ComparedConfiguration>& compared) {
  Timer timer(options, since, on_progress, compared);
  timer.run();
  return timer.mean_load();
}

}  // namespace triptych::comparison
