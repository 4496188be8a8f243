#pragma once
// The progress of measuring, as text for a terminal or for a log.

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "record/record.hpp"

namespace triptych::report {

// Determines whether a log that has been silent needs a sign of life. The intervals grow, so that a
// run of an hour has about 20 of them.
class SignsOfLife {
 public:
  using Clock = std::chrono::steady_clock;
  explicit SignsOfLife(std::function<Clock::time_point()> now = Clock::now);
  [[nodiscard]] bool due();
  // Call this when something else was written.
  void restart();

 private:
  std::function<Clock::time_point()> now_;
  Clock::time_point begun_;
  Clock::time_point last_;
};

// A terminal shows a bar in its last line, which is rewritten. A log gets a line for each device of
// a plan, a line for each of the first configurations that failed, and a sign of life from time to
// time, so that its length does not grow with the number of configurations.
class ProgressLog {
 public:
  using Clock = std::chrono::steady_clock;
  struct Options {
    std::size_t width = 0;                                // width of the terminal; 0 for a log
    bool verbose = false;                                 // a line for each configuration
    std::function<Clock::time_point()> now = Clock::now;  // replaced by tests
  };
  struct Step {
    std::string_view plan;
    std::string_view device;
    int done = 0;  // progress of the plan, over all devices
    int total = 0;
    std::chrono::seconds left{0};
    const record::Record* record = nullptr;  // the configuration that was just done
  };

  explicit ProgressLog(Options options);

  // Both return the text to be written. It may be empty, and each of its lines is safe on a
  // terminal.
  [[nodiscard]] std::string next(const Step& step);
  // A large data set is being loaded; `share` of it is done.
  [[nodiscard]] std::string loading(std::string_view data, double share);
  // Returns the lines that are still missing after the last configuration, and removes the bar.
  [[nodiscard]] std::string end();

 private:
  struct Tally {
    int measured = 0;
    int skipped = 0;
    int failed = 0;
    Clock::time_point begun;
    Clock::time_point ended;
  };

  [[nodiscard]] std::string line_for(const Step& step);
  [[nodiscard]] std::string bar(const Step& step) const;
  [[nodiscard]] std::string fitted(std::string_view text) const;
  [[nodiscard]] std::string summaries();
  void count(const record::Record& record);

  Options options_;
  SignsOfLife signs_;
  Clock::time_point last_;  // when the last configuration was done
  std::string plan_;
  std::map<std::pair<std::string, std::string>, Tally> tallies_;  // counts by plan and device
};

// The remaining time, rounded up: "34 s", "12 min", "3 h".
[[nodiscard]] std::string rough_time(std::chrono::seconds time);

}  // namespace triptych::report
