#pragma once
// Two sides measured in turns over a plan: which configurations are slower, and what else differs.

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "judge/baselines/work.hpp"
#include "judge/compare/differences.hpp"
#include "judge/compare/pairwise.hpp"
#include "measure/plan.hpp"
#include "measure/runner.hpp"
#include "measure/turns.hpp"

namespace triptych::comparison {

struct ComparisonOptions {
  measure::Plan plan;
  measure::SideOptions a;
  measure::SideOptions b;
  std::vector<measure::Plant> plants;  // into side b
  // From the start on; past it no configuration is continued. First looks and the confirmation of
  // suspects are always made: without them there is nothing to say.
  std::optional<std::chrono::seconds> budget;
  std::chrono::seconds limit{60};
  std::uint64_t seed = 1;
  judge::SequentialDesign design = judge::SequentialDesign::standard();
  judge::ConfirmationDesign confirmation;
};

// What is known of one configuration.
struct Compared {
  std::string key;
  measure::Configuration configuration;
  // Set when there is no time to compare, with the reason; skipped: a side cannot do this at all.
  std::optional<record::Outcome> ended;
  judge::PairVerdict verdict = judge::PairVerdict::undecided;
  std::string reason;  // of no verdict, or of one that the confirmation took back
  judge::Shift shift;  // of ln t, b against a; meaningless when ended
  int blocks = 0;      // of the first launch
  int launches = 0;    // fresh ones that confirmed, or did not
  int frames_per_turn = 1;
  measure::TurnClock clock = measure::TurnClock::wall;
  std::string why_wall;  // why not the device's clocks
  double seconds = 0;    // spent on it
  std::optional<judge::WorkChange> work;
  std::vector<judge::Difference> differences;

  [[nodiscard]] bool is_regression() const;
  [[nodiscard]] bool is_doubtful() const;
  // "slower", …, "skipped", "cannot tell"
  [[nodiscard]] std::string_view verdict_name() const;
};

struct ComparisonResult {
  record::Device a;
  record::Device b;
  std::vector<Compared> configurations;  // in the plan's order
  double seconds = 0;

  [[nodiscard]] core::ExitCode exit_code() const;
};

struct ComparisonProgress {
  std::string stage;  // "first look", "more blocks", "fresh launch 2 of 5"
  std::string configuration;
  int done = 0;
  int total = 0;
  std::chrono::seconds left{0};  // at most
  std::optional<measure::Loading> loading;
};

// The truth of a record with its bound, for as long as the comparison takes; throws core::Error
// where there is none.
using KeptTruth = std::function<const judge::TruthPair&(const record::Record&)>;

// Throws as measure::Turns does.
[[nodiscard]] ComparisonResult compare(const ComparisonOptions& options,
                                       const measure::Suite& suite, const KeptTruth& truth,
                                       const std::function<void(const ComparisonProgress&)>& tell);

}  // namespace triptych::comparison
