#pragma once
// A report about a failing frame, as Markdown to attach to a bug report for a driver.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "record/record.hpp"

namespace triptych::report {

struct BugReport {
  std::string message;  // how the frame fails, in one line
  record::Device device;
  std::map<std::string, std::string> system;  // Run::system
  std::string command;                        // shows the failure again
  // Factors that were made simpler.
  struct Change {
    std::string factor;
    std::string from;
    std::string to;
  };
  std::vector<Change> changes;
  std::map<std::string, std::string> factors;  // all factors, with their new values
  int frames = 0;                              // number of frames that were drawn to find them
  bool complete = true;                        // nothing simpler fails
  std::vector<std::string> files;              // files that belong to the report
};

[[nodiscard]] std::string markdown(const BugReport& report);

// "viewport 256 → 3, step 0.5 → 1"; "nothing" if there are no changes.
[[nodiscard]] std::string text_of(const std::vector<BugReport::Change>& changes);

}  // namespace triptych::report
