#pragma once
// The judge judged: how often it finds what was planted, and how often it finds what is not there.
// Counts and rates; what is replayed is in judge/evaluation/compare.hpp and
// judge/evaluation/runs.hpp.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "judge/compare/pairwise.hpp"

namespace triptych::judge {

// Clopper and Pearson's (1934) exact interval of a share of which `hits` of `trials` were seen: it
// holds the true one with at least this confidence. [0, 1] for no trials.
[[nodiscard]] Interval clopper_pearson(std::size_t hits, std::size_t trials,
                                       double confidence = 0.95);

struct Rate {
  std::size_t hits = 0;
  std::size_t trials = 0;
  [[nodiscard]] double share() const;  // NaN for no trials
  [[nodiscard]] Interval interval() const { return clopper_pearson(hits, trials); }
  void count(bool hit) {
    ++trials;
    hits += hit ? 1 : 0;
  }
};

// Where a trial's slowdown is.
enum class Spread : std::uint8_t {
  none,           // nowhere: A/A
  configuration,  // one, on one device
  level,          // all configurations of one factor level, on one device
  api,            // everything on the devices of one API
  global,         // everything but the anchors
  device,         // everything and the anchors: not the program's fault, nothing is to be found
  scrambled       // none, but times do not belong to their configurations: to be refused
};
[[nodiscard]] std::string_view name_of(Spread spread);

// The method of trials in which a new device is judged by the nearest of all others.
inline constexpr std::string_view by_the_nearest = "correlation, new device by the nearest";

// Trials of one kind are counted together.
struct TrialKind {
  // "compare", "history", "correlation, new device", "correlation, accepted device", by_the_nearest
  std::string method;
  std::string plan;     // whose configurations were measured
  std::string subject;  // a device, or "B by A"
  Spread spread = Spread::none;
  double percent = 0;  // planted
  // Two launches say it where one was in doubt, as under CTest; else one.
  bool confirmed = false;
  auto operator<=>(const TrialKind&) const = default;
};

// Percentages from which on a configuration's slowdown is counted with those of like size.
inline constexpr std::array<double, 7> cost_classes{0, 1, 2, 3, 5, 10, 20};

// What the correlation has to catch, in ln t.
[[nodiscard]] std::optional<double> must_be_caught(Spread spread);

struct Tally {
  Rate detected;           // trials in which (part of) what was planted is called slower; of
                           // Spread::scrambled, in which the pair is refused
  Rate found;              // planted configurations that are called slower
  Rate false_alarms;       // trials in which something is called slower that is not
  Rate false_discoveries;  // of all that is called slower, what is not
  Rate undecided;          // configurations about which nothing is said
  Rate first_named;        // of trials that name something: the first is what was planted
  Rate split;              // of what was found: more work, or more time for the same, told rightly
  // Of `found` in turns, and of `detected` by the correlation, what really cost so much that it has
  // to be caught.
  Rate to_be_caught;
  Rate left_open;   // trials of history in which noise leaves something open: the gate's code 2
  Rate in_doubt;    // of trials by one launch: the device is to be measured again
  Rate same_bytes;  // verdicts that were the same to the byte when asked for again
  // What was planted really cost, ln t planted over unplanted, of each trial: extra work has costs
  // of its own, which on short frames are larger than its share.
  std::vector<double> costs;
  // In turns: `found`, by the least percentage of cost_classes that it really cost.
  std::map<double, Rate> found_by_cost;
  double seconds = 0;              // of measuring, over all configurations of all trials
  std::size_t configurations = 0;  // those
};

using Tallies = std::map<TrialKind, Tally>;

// The smallest planted size from which on every size was found in at least `share` of the trials,
// by kind with its percent left out (0); nullopt: none was.
using SmallestFound = std::map<TrialKind, std::optional<double>>;
[[nodiscard]] SmallestFound smallest_found(const Tallies& tallies, double share = 0.95);

// Pairs of devices, "B by A", whose baseline was admitted in more than half of the A/A runs: of
// them it is asked what they find, of all others that they refuse.
struct JudgingPair {
  std::string method;  // of the correlation
  std::string plan;
  std::string subject;
  auto operator<=>(const JudgingPair&) const = default;
};
[[nodiscard]] std::set<JudgingPair> judging_pairs(const Tallies& tallies);

// What `compare` finds of single configurations, by what was planted there really cost.
[[nodiscard]] std::map<double, Rate> found_by_cost(const Tallies& tallies);

// What a project asks of its judge, with what was counted.
struct Aim {
  std::string text;
  Rate rate;
  double bound = 0;
  bool at_least = true;  // else at most
  // By the rate itself; nullopt where nothing was tried. The interval says how far to trust it.
  [[nodiscard]] std::optional<bool> met() const;
};
[[nodiscard]] std::vector<Aim> aims(const Tallies& tallies);

// A random order of 0 … count − 1, the same everywhere for one state of `random`.
[[nodiscard]] std::vector<std::size_t> shuffled(std::size_t count, core::Random& random);

}  // namespace triptych::judge
