#include "scene/atoms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>

#include "scene/elements.hpp"
#include "scene/nearest_neighbours.hpp"
#include "scene/particle_colours.hpp"

namespace triptych::scene {
namespace {

// How one kind is drawn.
struct Look {
  double radius = 0;
  Rgb rgb{};
  double intensity = 0;
};

// The kinds in an order that does not depend on which comes first in the file: elements by atomic
// number, types by number, others after them by name. Element k of the answer is the rank of kind k.
std::vector<std::size_t> ranks_of(const Atoms& atoms) {
  const auto key = [&atoms](std::size_t kind) {
    const std::string& name = atoms.kind_names[kind];
    const auto number =
    return std::tuple(number.value_or(std::numeric_limits<int>::max()), name);
  };
  std::vector<std::size_t> sorted(atoms.kind_names.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::ranges::sort(sorted, {}, key);
  std::vector<std::size_t> ranks(sorted.size());
  for (std::size_t rank = 0; rank < sorted.size(); ++rank) ranks[sorted[rank]] = rank;
  return ranks;
}

}  // namespace
}  // namespace triptych::scene
