#include "scene/nearest_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace triptych::scene {
namespace {

using Place = std::array<double, 3>;

double distance_squared(const Place& a, const Place& b) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return sum;
}

// A k-d tree without pointers: the middle element of each range splits it along the axis of that
// tree level. A grid would suit most data, but a single distant outlier would put all other points
// into one cell.
class Tree {
 public:
  explicit Tree(std::vector<Place>& places) : places_(places) { build(places_, 0); }

  // Returns the squared distance from a position to the nearest position that differs from it.
  [[nodiscard]] double nearest_squared(const Place& from) const {
    double best = std::numeric_limits<double>::infinity();
    search(places_, 0, from, best);
    return best;
  }

 private:
  static void build(std::span<Place> range, std::size_t axis) {
    if (range.size() < 2) return;
    const std::size_t middle = range.size() / 2;
    std::nth_element(range.begin(), range.begin() + static_cast<std::ptrdiff_t>(middle),
                     range.end(),
                     [axis](const Place& a, const Place& b) { return a[axis] < b[axis]; });
    build(range.first(middle), (axis + 1) % 3);
    build(range.subspan(middle + 1), (axis + 1) % 3);
  }

  static void search(std::span<const Place> range, std::size_t axis, const Place& from,
                     double& best) {
    if (range.empty()) return;
    const std::size_t middle = range.size() / 2;
    const Place& split = range[middle];
    if (split != from) best = std::min(best, distance_squared(split, from));
    const double offset = from[axis] - split[axis];
    const auto below = range.first(middle);
    const auto above = range.subspan(middle + 1);
    search(offset < 0 ? below : above, (axis + 1) % 3, from, best);
    if (offset * offset < best) search(offset < 0 ? above : below, (axis + 1) % 3, from, best);
  }

  std::span<Place> places_;
};

}  // namespace

std::optional<double> median_nearest_distance(std::vector<Place> places) {
  constexpr std::size_t most_queries = 100'000;
  std::erase_if(places, [](const Place& place) {
    return !std::ranges::all_of(place,
                                [](double x) { return std::isfinite(static_cast<float>(x)); });
  });
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  if (places.size() < 2) return std::nullopt;
  const std::size_t stride = (places.size() + most_queries - 1) / most_queries;
  std::vector<Place> queries;
  for (std::size_t i = 0; i < places.size(); i += stride) queries.push_back(places[i]);
  const Tree tree(places);
  std::vector<double> nearest;
  nearest.reserve(queries.size());
  for (const Place& place : queries) nearest.push_back(tree.nearest_squared(place));
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::ranges::nth_element(nearest, middle);
  return std::sqrt(*middle);
}

}  // namespace triptych::scene
