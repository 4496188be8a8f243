#pragma once
// A Markdown report about a failing frame, which users attach to a driver bug report.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "record/record.hpp"

namespace triptych::report {

struct BugReport {
  std::string title;                       // words::frame_title()
  std::string message;                     // how the frame fails, in one line
  std::vector<std::string> injected = {};  // faults that Triptych injected into the frame
  record::Device device;
  std::map<std::string, std::string> system;  // Run::system
  std::string command;                        // reproduces the failure
  // A factor whose level was simplified.
  struct Change {
    std::string factor;
    std::string from;
    std::string to;
  };
  std::vector<Change> changes;
  // If the frame fails only after other configurations: the plan, and the names of these
  // configurations in the order in which they are drawn. `changes` is empty in this case.
  std::string plan = {};
  std::vector<std::string> before = {};
  std::map<std::string, std::string> factors;  // all factors, with their simplified levels
  int frames = 0;                              // number of frames that the search drew
  bool complete = true;            // whether the search found that no simpler frame, or no shorter
                                   // sequence, fails
  std::vector<std::string> files;  // files that belong to the report
};

[[nodiscard]] std::string markdown(const BugReport& report);

// Returns "viewport 256 → 3, step 0.5 → 1", or "nothing" if there are no changes.
[[nodiscard]] std::string text_of(const std::vector<BugReport::Change>& changes);

}  // namespace triptych::report
