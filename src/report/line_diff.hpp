#pragma once
// Two texts line by line, as a side-by-side view shows them.

#include <string>
#include <string_view>
#include <vector>

namespace triptych::report {

struct LinePair {
  std::string before;  // empty where a line was added
  std::string now;     // empty where one was removed
  bool changed = false;
};

// The lines that changed with `context` unchanged ones around them, in order; lines left out in
// between make one pair of "…". By the longest common subsequence of lines.
[[nodiscard]] std::vector<LinePair> line_diff(std::string_view before, std::string_view now,
                                              std::size_t context = 3);

}  // namespace triptych::report
