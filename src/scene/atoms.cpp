#include "scene/atoms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "scene/elements.hpp"
#include "scene/nearest_neighbours.hpp"
#include "scene/particle_colours.hpp"

namespace triptych::scene {
namespace {

// The appearance of one element or type.
struct Appearance {
  double radius = 0;
  Rgb rgb{};
  double intensity = 0;
};

// Returns the rank of each kind (element or numbered type). Ranks do not depend on the order of the
// kinds in the file: elements are sorted by atomic number, numbered types by number, and all other
// kinds follow, sorted by name.
std::vector<std::size_t> ranks_of(const Atoms& atoms) {
  const auto key = [&atoms](std::size_t kind) {
    const std::string& name = atoms.kind_names[kind];
    const auto number = atoms.elements ? atomic_number(name) : parse_number<int>(name);
    return std::pair(number.value_or(std::numeric_limits<int>::max()), name);
  };
  std::vector<std::size_t> sorted(atoms.kind_names.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::ranges::sort(sorted, {}, key);
  std::vector<std::size_t> ranks(sorted.size());
  for (std::size_t rank = 0; rank < sorted.size(); ++rank) ranks[sorted[rank]] = rank;
  return ranks;
}

// Returns half the median distance between nearest neighbours, or ½ if all atoms are at the same
// position.
double radius_without_elements(const Atoms& atoms) {
  constexpr double coincident_radius = 0.5;
  const auto distance = median_nearest_distance(atoms.places);
  return distance ? *distance / 2 : coincident_radius;
}

std::vector<Appearance> appearances_of(const Atoms& atoms) {
  constexpr double golden_ratio = 0.6180339887498949;  // gives successive ranks very different hues
  const std::vector<std::size_t> ranks = ranks_of(atoms);
  const bool radius_by_type = !atoms.elements && atoms.radii.empty();
  const double type_radius = radius_by_type ? radius_without_elements(atoms) : 0;
  std::vector<Appearance> appearances;
  for (std::size_t kind = 0; kind < ranks.size(); ++kind) {
    const std::string& name = atoms.kind_names[kind];
    const auto rank = static_cast<double>(ranks[kind]);
    Appearance appearance;
    appearance.intensity = rank / static_cast<double>(ranks.size());
    appearance.radius = atoms.elements ? van_der_waals_radius(name) * atoms.angstrom : type_radius;
    const double turns = golden_ratio * rank;
    appearance.rgb = atoms.elements ? element_colour(name) : hue_colour(turns - std::floor(turns));
    appearances.push_back(appearance);
  }
  return appearances;
}

// Returns the atoms' indices, sorted by the atoms' numbers. Rejects a number that appears twice.
std::vector<std::uint32_t> sorted_by_number(const Atoms& atoms, const LineReader& reader,
                                            int first_line) {
  std::vector<std::uint32_t> sorted(atoms.places.size());
  std::iota(sorted.begin(), sorted.end(), 0U);
  if (atoms.order.empty()) return sorted;
  const auto number = [&atoms](std::uint32_t index) { return atoms.order[index]; };
  std::ranges::stable_sort(sorted, {}, number);
  const auto duplicate = std::ranges::adjacent_find(sorted, {}, number);
  if (duplicate != sorted.end()) {
    const std::uint32_t second = *std::next(duplicate);
    reader.reject_at(
        first_line + static_cast<int>(second),
        fmt::format("atom number {} appears twice; atom numbers must be unique", number(second)));
  }
  return sorted;
}

// Returns the number of atoms of each kind (element or numbered type), in the order of ranks_of().
std::vector<ReadFacts::Kind> counted_kinds(const Atoms& atoms) {
  const std::vector<std::size_t> ranks = ranks_of(atoms);
  std::vector<ReadFacts::Kind> kinds(ranks.size());
  for (std::size_t kind = 0; kind < ranks.size(); ++kind) {
    kinds[ranks[kind]].name = atoms.kind_names[kind];
  }
  for (const std::uint32_t kind : atoms.kinds) ++kinds[ranks[kind]].count;
  return kinds;
}

// Returns a list such as "3 of 'Xx', 1 of 'Qq'" of the kinds that are not elements. The list is
// empty if every kind is an element.
std::string without_element(const std::vector<ReadFacts::Kind>& kinds) {
  std::string list;
  for (const auto& [name, count] : kinds) {
    if (atomic_number(name)) continue;
    list += fmt::format("{}{} of '{}'", list.empty() ? "" : ", ", count, quotable(name));
  }
  return list;
}

ReadFacts facts_of(Atoms& atoms) {
  ReadFacts facts{.kinds = counted_kinds(atoms),
                  .elements = atoms.elements,
                  .frames = atoms.frames,
                  .box_edges = atoms.box_edges,
                  .value_type = {},
                  .orientation = {},
                  .notes = std::move(atoms.notes)};
  if (!atoms.elements || !atoms.radii.empty()) return facts;
  if (const std::string list = without_element(facts.kinds); !list.empty()) {
    facts.notes.push_back(
        fmt::format("some atoms do not belong to a known chemical element ({}); they are drawn "
                    "with a radius of 2 Å and arbitrary colours",
                    list));
  }
  return facts;
}

}  // namespace

std::uint32_t Atoms::kind(std::string_view name) {
  const auto found = index_.find(name);
  if (found != index_.end()) return found->second;
  const auto index = static_cast<std::uint32_t>(kind_names.size());
  kind_names.emplace_back(name);
  index_.emplace(name, index);
  return index;
}

ParticleSet to_particles(Atoms atoms, ColourKind colour, const LineReader& reader, int first_line) {
  const std::vector<Appearance> appearances = appearances_of(atoms);
  const std::vector<std::uint32_t> sorted = sorted_by_number(atoms, reader, first_line);
  const bool is_single_kind = appearances.size() == 1;
  const auto total = static_cast<double>(sorted.size());
  ParticleSet set;
  set.colour = colour;
  set.facts = facts_of(atoms);
  reserve(set, sorted.size());
  for (std::uint32_t id = 0; id < sorted.size(); ++id) {
    const std::uint32_t index = sorted[id];
    const Appearance& appearance = appearances[atoms.kinds[index]];
    const auto& place = atoms.places[index];
    const double radius = atoms.radii.empty() ? appearance.radius : atoms.radii[index];
    if (!append(set, {place[0], place[1], place[2], radius}, id)) continue;
    append_colour(set, appearance.rgb, is_single_kind ? id / total : appearance.intensity);
  }
  return set;
}

}  // namespace triptych::scene
