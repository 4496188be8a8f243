#pragma once
// Compares two texts line by line, as a side-by-side view shows them.

#include <string>
#include <string_view>
#include <vector>

namespace triptych::report {

struct LinePair {
  std::string before;  // empty if the line was added
  std::string now;     // empty if the line was removed
  bool changed = false;
};

// The lines that changed, with `context` unchanged lines around them, in order. Lines that are left
// out in between become one pair of "…". Uses the longest common subsequence of lines.
[[nodiscard]] std::vector<LinePair> line_diff(std::string_view before, std::string_view now,
                                              std::size_t context = 3);

}  // namespace triptych::report
