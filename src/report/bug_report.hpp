#pragma once
// A frame that fails, as Markdown to be attached to a report on a driver.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "record/record.hpp"

namespace triptych::report {

struct BugReport {
  std::string message;  // how it fails, one line
  record::Device device;
  std::map<std::string, std::string> system;  // Run::system
  std::string command;                        // that shows it again
  // Of factors that are plainer than they were.
  struct Change {
    std::string factor;
    std::string from;
    std::string to;
  };
  std::vector<Change> changes;
  std::map<std::string, std::string> factors;  // all, as they are now
  int frames = 0;                              // drawn to find them
  bool complete = true;                        // nothing plainer fails
  std::vector<std::string> files;              // beside it
};

[[nodiscard]] std::string markdown(const BugReport& report);

// "viewport 256 → 3, step 0.5 → 1"; "nothing" where there is no change.
[[nodiscard]] std::string text_of(const std::vector<BugReport::Change>& changes);

}  // namespace triptych::report
