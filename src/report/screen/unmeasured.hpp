#pragma once
// The reasons why configurations of a run were not measured, for the terminal.

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "record/record.hpp"

namespace triptych::report {

// Groups the records of a run that were not measured by their outcome and reason.
class Unmeasured {
 public:
  void add(const record::Record& record);
  // Returns one line for each group, such as "10 skipped on opencl:pocl: REASON". The largest group
  // comes first. At most `most_lines` groups are listed, and a last line counts the remaining ones.
  // Control characters are escaped.
  [[nodiscard]] std::vector<std::string> lines() const;

  static constexpr std::size_t most_lines = 8;

 private:
  struct Group {
    record::Outcome outcome = record::Outcome::skipped;
    record::Reason reason;
    int count = 0;
    std::set<std::string> devices;
  };
  std::vector<Group> groups_;
};

}  // namespace triptych::report
