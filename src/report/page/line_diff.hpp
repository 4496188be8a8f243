#pragma once
// Compares two multi-line strings line by line, for a side-by-side view.

#include <string>
#include <string_view>
#include <vector>

namespace triptych::report {

struct LinePair {
  std::string before;  // empty if the line was added
  std::string now;     // empty if the line was removed
  bool changed = false;
};

// Returns the changed lines in order, each with `context` unchanged lines around it. A pair of "…"
// stands for unchanged lines that are left out in between. Uses the longest common subsequence of
// lines.
[[nodiscard]] std::vector<LinePair> line_diff(std::string_view before, std::string_view now,
                                              std::size_t context = 3);

}  // namespace triptych::report
