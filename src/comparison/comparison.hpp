#pragma once
// Two sides over a plan: first what repeats – pictures, counters, statistics, cost, memory – then
// times, interleaved.

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "comparison/pairwise.hpp"
#include "comparison/run_diff.hpp"
#include "measure/plan/plan.hpp"
#include "measure/run/interleaved.hpp"
#include "measure/run/runner.hpp"

namespace triptych::comparison {

struct ComparisonOptions {
  measure::Plan plan;
  measure::SideOptions a;
  measure::SideOptions b;
  std::vector<measure::InjectedFault> faults;  // into side b
  // From the start on; past it no configuration is continued. First looks and the confirmation of
  // suspects are always made: without them there is nothing to say.
  std::optional<std::chrono::seconds> budget;
  std::chrono::seconds limit{60};
  std::uint64_t seed = 1;
  bool times = true;  // of a plan that is timed
  SequentialDesign design = SequentialDesign::standard();
  ConfirmationDesign confirmation;
};

// What is known of one configuration.
struct Compared {
  std::string key;
  measure::Configuration configuration;
  // How the side ended that did not do its part, with the reason; skipped: it cannot.
  std::optional<record::Outcome> ended;
  PairVerdict verdict = PairVerdict::undecided;
  std::string reason;    // of no verdict, or of one that the confirmation took back
  Shift shift;           // of ln t, b against a; meaningless when ended
  int blocks = 0;        // of the first process run
  int process_runs = 0;  // fresh ones that confirmed, or did not
  int frames_per_batch = 1;
  measure::SideClock clock = measure::SideClock::wall;
  std::string why_wall;  // why not the device's clocks
  double seconds = 0;    // spent on it
  std::optional<judge::WorkChange> work;
  std::vector<Difference> differences;

  [[nodiscard]] bool is_regression() const;
  [[nodiscard]] bool is_doubtful(bool timed) const;
  // Of its time: "slower", …, "skipped", "cannot tell"
  [[nodiscard]] std::string_view verdict_name() const;
};

struct ComparisonResult {
  record::Device a;
  record::Device b;
  bool timed = false;
  std::vector<Difference> device;        // of the two as such
  std::vector<Compared> configurations;  // in the plan's order
  double seconds = 0;

  [[nodiscard]] core::ExitCode exit_code() const;
};

struct ComparisonProgress {
  std::string stage;  // "what repeats", "first look", "more blocks", "fresh process run 2 of 5"
  std::string configuration;
  int done = 0;
  int total = 0;
  std::chrono::seconds left{0};  // at most
  std::optional<measure::Loading> loading;
};

using Tell = std::function<void(const ComparisonProgress&)>;

// Both sides' runs go into the store. Throws as measure::run_sides and measure::Interleaved do.
[[nodiscard]] ComparisonResult compare(const ComparisonOptions& options,
                                       const measure::Suite& suite, record::Store& store,
                                       measure::Truths& truths, const Tell& tell);

}  // namespace triptych::comparison
