#include "report/page/line_diff.hpp"

#include <algorithm>
#include <cstdint>

namespace triptych::report {
namespace {

using Lines = std::vector<std::string_view>;

Lines lines_of(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

// For each i and j, the length of the longest common subsequence of the lines of `a` from i on and
// the lines of `b` from j on.
class Lengths {
 public:
  Lengths(const Lines& a, const Lines& b)
      : columns_(b.size() + 1), lengths_((a.size() + 1) * columns_) {
    for (std::size_t i = a.size(); i-- > 0;) {
      for (std::size_t j = b.size(); j-- > 0;) {
        lengths_[i * columns_ + j] =
            a[i] == b[j] ? at(i + 1, j + 1) + 1 : std::max(at(i + 1, j), at(i, j + 1));
      }
    }
  }
  [[nodiscard]] std::uint32_t at(std::size_t i, std::size_t j) const {
    return lengths_[i * columns_ + j];
  }

 private:
  std::size_t columns_;
  std::vector<std::uint32_t> lengths_;
};

// Pairs removed lines with added lines, in order, and clears both lists.
void pair_up(std::vector<LinePair>& pairs, Lines& removed, Lines& added) {
  for (std::size_t i = 0; i < std::max(removed.size(), added.size()); ++i) {
    pairs.push_back({i < removed.size() ? std::string(removed[i]) : std::string(),
                     i < added.size() ? std::string(added[i]) : std::string(), true});
  }
  removed.clear();
  added.clear();
}

std::vector<LinePair> all_pairs(const Lines& a, const Lines& b) {
  const Lengths lengths(a, b);
  std::vector<LinePair> pairs;
  Lines removed;
  Lines added;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() || j < b.size()) {
    if (i < a.size() && j < b.size() && a[i] == b[j]) {
      pair_up(pairs, removed, added);
      pairs.push_back({std::string(a[i++]), std::string(b[j++]), false});
    } else if (j == b.size() || (i < a.size() && lengths.at(i + 1, j) >= lengths.at(i, j + 1))) {
      removed.push_back(a[i++]);
    } else {
      added.push_back(b[j++]);
    }
  }
  pair_up(pairs, removed, added);
  return pairs;
}

}  // namespace

std::vector<LinePair> line_diff(std::string_view before, std::string_view now,
                                std::size_t context) {
  const std::vector<LinePair> all = all_pairs(lines_of(before), lines_of(now));
  std::vector<bool> shown(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].changed) continue;
    const std::size_t first = i > context ? i - context : 0;
    for (std::size_t k = first; k < std::min(all.size(), i + context + 1); ++k) shown[k] = true;
  }
  std::vector<LinePair> pairs;
  bool gap = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!shown[i]) {
      gap = true;
      continue;
    }
    if (gap && !pairs.empty()) pairs.push_back({"…", "…", false});
    gap = false;
    pairs.push_back(all[i]);
  }
  return pairs;
}

}  // namespace triptych::report
