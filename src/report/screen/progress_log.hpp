#pragma once
// Formats the progress of a measurement for a terminal or a log.

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "record/record.hpp"

namespace triptych::report {

// Decides when to write a progress line to a log to which nothing was written for a while. The
// intervals grow, so that the log of a one-hour run gets about 20 such lines.
class Heartbeat {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Heartbeat(std::function<Clock::time_point()> now = Clock::now);
  [[nodiscard]] bool due();
  // Restarts the interval. Call this after other output was written.
  void restart();

 private:
  std::function<Clock::time_point()> now_;
  Clock::time_point started_;
  Clock::time_point last_;
};

// On a terminal, the last line shows a progress bar, which is redrawn. A log gets a line for each
// device of a plan, a line for each of the first few failures, and a progress line from time to
// time, so that its length does not grow with the number of configurations.
class ProgressLog {
 public:
  using Clock = std::chrono::steady_clock;
  struct Options {
    std::size_t width = 0;                                // width of the terminal; 0 for a log
    bool verbose = false;                                 // write a line for each configuration
    std::function<Clock::time_point()> now = Clock::now;  // replaced by tests
    // The number of configurations that are to be measured, over all devices, for each plan in the
    // order of measurement. If there are several plans, the remaining time is that of all of them.
    std::vector<std::pair<std::string, int>> planned = {};
  };
  struct Step {
    std::string_view plan;
    std::string_view device;
    int done = 0;  // progress of the plan, over all devices
    int total = 0;
    std::chrono::seconds left{0};            // remaining time of the plan
    const record::Record* record = nullptr;  // the configuration that was just measured, if any
  };

  explicit ProgressLog(Options options);

  // Returns the output after a step, which may be empty. Control characters in names and messages
  // are escaped.
  [[nodiscard]] std::string next(const Step& step);
  // Returns the output while a large data set is being loaded, of which `share` is already loaded.
  [[nodiscard]] std::string loading(std::string_view data, double share);
  // Returns the output after the last configuration: the remaining summaries. Removes the bar.
  [[nodiscard]] std::string end();

 private:
  struct Tally {
    int measured = 0;
    int skipped = 0;
    int failed = 0;
    Clock::time_point started;
    Clock::time_point ended;
  };

  [[nodiscard]] std::string line_for(const Step& step);
  [[nodiscard]] std::string progress_line(const Step& step) const;
  [[nodiscard]] std::string bar(const Step& step) const;
  [[nodiscard]] std::string fitted(std::string_view text) const;
  [[nodiscard]] std::string summaries();
  void count(const record::Record& record);
  [[nodiscard]] bool has_several_plans() const { return options_.planned.size() > 1; }
  // Returns the number of configurations of all plans that are to be measured.
  [[nodiscard]] int planned_in_all() const;
  [[nodiscard]] std::size_t number_of_plan(std::string_view plan) const;
  // Returns the remaining time: of all plans if there are several, otherwise of the only plan.
  [[nodiscard]] std::chrono::seconds time_left(const Step& step) const;

  Options options_;
  Heartbeat heartbeat_;
  Clock::time_point started_;
  Clock::time_point last_;  // when the last configuration ended
  int done_ = 0;            // number of measured configurations of all plans
  std::string plan_;
  std::map<std::pair<std::string, std::string>, Tally> tallies_;  // counts by plan and device
};

// Reports the progress of work of which only the completed share is known, such as rendering a
// large image. Work that takes less than a second is not reported.
class ShareLog {
 public:
  explicit ShareLog(ProgressLog::Options options);

  // Returns the output when this share of the work, in [0, 1], is complete; it may be empty. A
  // share of 0 begins a new work. A share of 1 removes the bar from a terminal.
  [[nodiscard]] std::string next(std::string_view what, double share);

 private:
  ProgressLog::Options options_;
  ProgressLog::Clock::time_point started_;
  ProgressLog::Clock::time_point last_;
  bool shown_ = false;
};

// Formats a duration, rounded up: "34 s", "12 min", "3 h".
[[nodiscard]] std::string rounded_duration(std::chrono::seconds time);

}  // namespace triptych::report
