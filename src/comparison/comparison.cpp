#include "comparison/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/image_io.hpp"
#include "measure/plant.hpp"
#include "measure/stopwatch.hpp"

namespace triptych::comparison {
namespace {

using judge::PairVerdict;
using measure::Side;
using measure::TurnClock;

// Pictures, counters and statistics come from one ordinary job; its few timed frames only tell
// whether the device's clock can be believed about this work.
constexpr measure::Protocol looking_protocol{.warm_up_frames = 2,
                                             .timed_frames = 8,
                                             .least_loop_ns = 0,
                                             .most_loop_frames = 1,
                                             .statistics = true,
                                             .counters = true};

// A configuration with what it takes to go on measuring it.
struct Entry {
  Compared& compared;
  std::array<std::vector<std::string>, 2> plants;
  std::vector<measure::Block> blocks;
};

class Comparer {
 public:
  Comparer(const ComparisonOptions& options, const measure::Suite& suite, const KeptTruth& truth,
           const std::function<void(const ComparisonProgress&)>& tell)
      : options_(options),
        suite_(suite),
        truth_(truth),
        tell_(tell),
        same_setup_(options.a.environment == options.b.environment &&
                    options.a.command == options.b.command),
        turns_({.suite = options.plan.suite,
                .kinds = measure::work_kinds(options.plan),
                .limit = options.limit,
                .seed = options.seed},
               options.a, options.b) {
    result_.a = turns_.hello(Side::a).device;
    result_.b = turns_.hello(Side::b).device;
    for (const measure::Configuration& each : options.plan.configurations) {
      result_.configurations.push_back(
          {.key = measure::configuration_key(suite, each), .configuration = each});
    }
    for (Compared& each : result_.configurations) {
      entries_.push_back({each,
                          {std::vector<std::string>{},
                           measure::faults_for(options_.plants, each.key, options_.b.device)},
                          {}});
    }
  }

  ComparisonResult run() && {
    first_looks();
    go_on_with_the_widest();
    confirm_suspects();
    for (Entry& entry : entries_) conclude(entry);
    result_.seconds = since_start_.seconds();
    return std::move(result_);
  }

 private:
  // Does `act` for a configuration: its time is counted, a side's end is its own.
  template <typename Act>
  void about(Entry& entry, const Act& act) {
    const measure::Stopwatch stopwatch;
    try {
      act();
    } catch (const measure::SideEnded& ended) {
      held_ = nullptr;
      entry.compared.ended = ended.outcome();
      entry.compared.reason = ended.what();
      const bool fault_of_b =
          ended.side() == Side::b && ended.outcome() != record::Outcome::skipped;
      if (fault_of_b) {
        entry.compared.differences.push_back(
            {judge::DifferenceKind::regression, "outcome", ended.what()});
      }
    }
    entry.compared.seconds += stopwatch.seconds();
  }

  void first_looks() {
    int done = 0;
    const int total = static_cast<int>(entries_.size());
    const int first = options_.design.looks.front();
    for (Entry& entry : entries_) {
      const double each_s = done > 0 ? since_start_.seconds() / done : 0;
      say("first look", entry, done, total, each_s * (total - done));
      about(entry, [&] {
        look_at_both(entry);
        if (!entry.compared.reason.empty()) return;  // a wrong picture: its time means nothing
        draw_until(entry, first);
        judge_blocks(entry);
      });
      ++done;
    }
  }

  measure::OnLoading loading_of(const Entry& entry) {
    return [this, &entry](const measure::Loading& loading) {
      if (tell_) tell_({.stage = {}, .configuration = entry.compared.key, .loading = loading});
    };
  }

  [[nodiscard]] measure::Answer measure_one(Side side, const Entry& entry) {
    const std::string& key = entry.compared.key;
    measure::Answer answer =
        turns_.measure(side,
                       {.name = fmt::format("{}/{}", measure::name_of(side), key),
                        .configuration = entry.compared.configuration,
                        .protocol = looking_protocol,
                        .plants = entry.plants.at(side == Side::a ? 0 : 1)},
                       loading_of(entry));
    record::Record& record = answer.record;
    record.suite = options_.plan.suite;
    record.plan = options_.plan.name;
    record.configuration = key;
    record.scene = measure::scene_key(suite_, entry.compared.configuration);
    record.technique = entry.compared.configuration.at("technique");
    record.device = turns_.hello(side).device.id;
    return answer;
  }

  // Everything but time, and which clock is to be used.
  void look_at_both(Entry& entry) {
    release();
    const measure::Answer a = measure_one(Side::a, entry);
    const measure::Answer b = measure_one(Side::b, entry);
    const core::Image image_a =
        a.exr.empty() ? core::Image() : core::decode_exr(a.exr, "the picture of a");
    const core::Image image_b =
        b.exr.empty() ? core::Image() : core::decode_exr(b.exr, "the picture of b");
    judge::ComparedSide side_a{a.record, result_.a, image_a};
    judge::ComparedSide side_b{b.record, result_.b, image_b};
    find_truth(side_a);
    find_truth(side_b);
    judge::Comparison found = judge::find_differences(side_a, side_b, same_setup_);
    entry.compared.differences = std::move(found.differences);
    entry.compared.reason = std::move(found.void_time);
    entry.compared.work = judge::work_change(b.record.counters, a.record.counters);
    choose_clock(entry.compared, a.record, b.record);
  }

  void find_truth(judge::ComparedSide& side) {
    if (side.record.image.empty()) return;
    try {
      side.truth = &truth_(side.record);
    } catch (const core::Error& error) {
      side.no_truth = error.what();
    }
  }

  static void choose_clock(Compared& compared, const record::Record& a, const record::Record& b) {
    if (a.device_clock_trusted && b.device_clock_trusted) {
      compared.clock = TurnClock::device;
      return;
    }
    const bool neither = !a.device_clock_trusted && !b.device_clock_trusted;
    compared.why_wall = fmt::format("the device clock of {} cannot be believed here",
                                    neither                  ? "neither side"
                                    : a.device_clock_trusted ? "side b"
                                                             : "side a");
    if (neither) compared.why_wall = "the device clocks of both sides cannot be believed here";
  }

  void release() {
    if (held_ != nullptr) {
      held_ = nullptr;
      turns_.release();
    }
  }

  void hold(Entry& entry) {
    if (held_ == &entry) return;
    held_ = nullptr;
    turns_.hold(entry.compared.configuration, entry.plants, entry.compared.clock,
                loading_of(entry));
    entry.compared.frames_per_turn = turns_.frames_per_turn();
    held_ = &entry;
  }

  void draw_until(Entry& entry, int blocks) {
    hold(entry);
    const bool first = entry.blocks.empty();
    while (static_cast<int>(entry.blocks.size()) < blocks && (first || !over_budget())) {
      entry.blocks.push_back(turns_.block());
    }
  }

  void judge_blocks(Entry& entry) {
    Compared& compared = entry.compared;
    if (compared.clock == TurnClock::device && !measure::device_clock_holds(entry.blocks)) {
      compared.clock = TurnClock::wall;
      compared.why_wall = "the device times of these turns cannot be true";
    }
    const judge::Look look =
        judge::look_at(measure::differences(entry.blocks, compared.clock), options_.design);
    compared.verdict = look.verdict;
    compared.shift = look.shift;
    compared.blocks = static_cast<int>(entry.blocks.size());
  }

  [[nodiscard]] bool over_budget() const {
    return options_.budget && since_start_.elapsed() >= *options_.budget;
  }

  [[nodiscard]] bool may_go_on(const Entry& entry) const {
    const Compared& compared = entry.compared;
    return !compared.ended && compared.reason.empty() &&
           compared.verdict == PairVerdict::undecided &&
           options_.design.next_look(compared.blocks) > 0;
  }

  // At most: every block that could still be asked for, or the budget.
  [[nodiscard]] double most_left_s() const {
    double left = 0;
    for (const Entry& entry : entries_) {
      if (!may_go_on(entry)) continue;
      left += entry.compared.seconds / entry.compared.blocks *
              (options_.design.looks.back() - entry.compared.blocks);
    }
    if (!options_.budget) return left;
    return std::min(
        left, std::chrono::duration<double>(*options_.budget).count() - since_start_.seconds());
  }

  void go_on_with_the_widest() {
    while (!over_budget()) {
      Entry* widest = nullptr;
      int open = 0;
      for (Entry& entry : entries_) {
        if (!may_go_on(entry)) continue;
        ++open;
        const auto width = [](const Entry& each) {
          return each.compared.shift.interval.half_width();
        };
        if (widest == nullptr || width(entry) > width(*widest)) widest = &entry;
      }
      if (widest == nullptr) return;
      const int total = static_cast<int>(entries_.size());
      say("more blocks", *widest, total - open, total, most_left_s());
      about(*widest, [&] {
        // The look at the budget's end is one of those that were planned.
        draw_until(*widest, options_.design.next_look(widest->compared.blocks));
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
    std::vector<judge::Suspect> launched;
    for (const Entry* entry : suspected) {
      launched.push_back({{}, entry->compared.verdict == PairVerdict::slower});
    }
    const measure::Stopwatch stopwatch;
    int done = 0;
    const auto launch = [&](std::span<const std::size_t> open, std::size_t number,
                            std::size_t until) {
      const bool enough = number > judge::least_launches && over_budget();
      const bool all_ended = std::ranges::all_of(
          open, [&](std::size_t i) { return suspected[i]->compared.ended.has_value(); });
      if (enough || all_ended || !relaunched()) return false;
      const auto left = static_cast<int>((until - number + 1) * open.size());
      const int total = done + left;
      for (const std::size_t i : open) {
        const double each_s = done > 0 ? stopwatch.seconds() / done : 0;
        say(fmt::format("fresh launch {} of {}", number, until), *suspected[i], done, total,
            each_s * (total - done));
        launch_again(*suspected[i], launched[i]);
        ++done;
      }
      return true;
    };
    const auto confirmed =
        judge::confirm_in_looks(launched, options_.confirmation, options_.design, launch);
    for (std::size_t i = 0; i < suspected.size(); ++i) {
      if (!suspected[i]->compared.ended) take(confirmed[i], launched[i], suspected[i]->compared);
    }
  }

  // What is not confirmed for lack of launches says so.
  bool relaunched() {
    held_ = nullptr;
    try {
      turns_.relaunch();
      return true;
    } catch (const measure::SideEnded&) {
      return false;
    }
  }

  void launch_again(Entry& entry, judge::Suspect& suspect) {
    if (entry.compared.ended) return;
    about(entry, [&] {
      hold(entry);
      std::vector<measure::Block> blocks;
      while (blocks.size() < options_.confirmation.blocks_per_launch) {
        blocks.push_back(turns_.block());
      }
      if (entry.compared.clock == TurnClock::device && !measure::device_clock_holds(blocks)) return;
      const auto differences = measure::differences(blocks, entry.compared.clock);
      const double level = options_.design.alpha_of_a_look();
      suspect.launches.push_back(judge::estimate_shift(differences, level).estimate);
    });
  }

  static void take(const judge::Confirmation& confirmed, const judge::Suspect& suspect,
                   Compared& compared) {
    const auto suspected = std::exchange(compared.verdict, confirmed.verdict);
    if (suspect.launches.size() < judge::least_launches) {
      compared.reason = fmt::format("{} at first, but fresh launches could not be measured",
                                    judge::name_of(suspected));
      return;
    }
    compared.launches = static_cast<int>(suspect.launches.size());
    if (confirmed.verdict != suspected) {
      compared.reason = fmt::format("{} in one launch by {:+.2f} %, not so in {} fresh ones",
                                    judge::name_of(suspected),
                                    100 * std::expm1(compared.shift.estimate), compared.launches);
    }
    compared.shift = confirmed.shift;
  }

  void conclude(Entry& entry) {
    Compared& compared = entry.compared;
    if (compared.blocks == 0) compared.work.reset();
    const bool unexplained = !compared.ended && compared.reason.empty();
    if (unexplained && compared.verdict == PairVerdict::undecided) {
      const bool all = options_.design.next_look(compared.blocks) == 0;
      compared.reason = fmt::format("{} after {} blocks, the interval is ±{:.2f} % wide",
                                    all ? "undecided" : "the budget ended", compared.blocks,
                                    100 * std::expm1(compared.shift.interval.half_width()));
    }
  }

  void say(std::string stage, const Entry& entry, int done, int total, double left_s) {
    if (!tell_) return;
    tell_({.stage = std::move(stage),
           .configuration = entry.compared.key,
           .done = done,
           .total = total,
           .left = std::chrono::seconds(static_cast<long>(std::ceil(std::max(0.0, left_s)))),
           .loading = {}});
  }

  const ComparisonOptions& options_;
  const measure::Suite& suite_;
  const KeptTruth& truth_;
  const std::function<void(const ComparisonProgress&)>& tell_;
  bool same_setup_;
  measure::Stopwatch since_start_;
  measure::Turns turns_;
  ComparisonResult result_;
  std::vector<Entry> entries_;
  const Entry* held_ = nullptr;  // by both workers
};

}  // namespace

ComparisonResult compare(const ComparisonOptions& options, const measure::Suite& suite,
                         const KeptTruth& truth,
                         const std::function<void(const ComparisonProgress&)>& tell) {
  return Comparer(options, suite, truth, tell).run();
}

}  // namespace triptych::comparison
