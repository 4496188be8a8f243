#include "core/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace triptych::core {
namespace {

// Returns the Levenshtein distance: the number of insertions, deletions and replacements of single
// characters.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view wrong,
                                        const std::vector<std::string>& known) {
  const auto distance = [&](const std::string& each) { return edit_distance(wrong, each); };
  const auto nearest = std::ranges::min_element(known, {}, distance);
  if (nearest == known.end()) return std::nullopt;
  if (distance(*nearest) > std::max<std::size_t>(2, wrong.size() / 3)) return std::nullopt;
  return *nearest;
}

}  // namespace triptych::core
