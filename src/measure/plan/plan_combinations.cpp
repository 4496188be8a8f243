#include "measure/plan/plan_combinations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "measure/plan/plan_values.hpp"

namespace triptych::measure {
namespace {

// Returns how fast a change of the factor's level is, from 0 (slowest) to 3: 0 if data must be
// loaded, or their values mapped again; 1 if a pipeline must be built; 2 if only the viewport
// changes; 3 if only the camera moves.
int speed_of(const Factor& factor) {
  if (factor.name == "data" || factor.name == "window" || factor.name == "mapping") return 0;
  if (factor.name == "viewport") return 2;
  if (factor.name == "camera") return 3;
  return 1;
}

bool contains(const std::vector<std::string>& values, const std::string& value) {
  return std::ranges::find(values, value) != values.end();
}

}  // namespace

std::vector<const Factor*> slowest_first(const Suite& suite) {
  std::vector<const Factor*> factors;
  for (const Factor& each : suite.factors()) factors.push_back(&each);
  std::ranges::stable_sort(factors, {}, [](const Factor* factor) { return speed_of(*factor); });
  return factors;
}

Combinations::Combinations(const Suite& suite, const std::vector<ValuesByFactor>& blocks) {
  for (const ValuesByFactor& values : blocks) {
    Block& block = blocks_.emplace_back();
    for (const Factor* factor : slowest_first(suite)) {
      const auto given = values.find(factor->name);
      block.push_back(
          {factor->name, given == values.end() ? std::vector{default_of(*factor)} : given->second});
    }
    for (const std::string& each : data_of(block)) {
      if (!contains(data_, each)) data_.push_back(each);
    }
  }
}

void Combinations::for_each(const Shard& shard, const Use& use) const {
  const auto [index, count] = shard;
  if (count < 1 || index < 1 || index > count) {
    throw core::InputError(fmt::format("shard {}/{}: expected i/n with 1 ≤ i ≤ n", index, count));
  }
  const auto shards = static_cast<std::size_t>(count);
  const auto own_index = static_cast<std::size_t>(index - 1);
  const std::size_t whole = data_.size() / shards * shards;
  std::size_t rest = 0;
  for (std::size_t i = 0; i < data_.size(); ++i) {
    if (i >= whole) {
      for_each_of(data_[i], [&](const Configuration& each) {
        if (rest++ % shards == own_index) use(each);
      });
    } else if (i % shards == own_index) {
      for_each_of(data_[i], use);
    }
  }
}

std::size_t Combinations::upper_bound_of(std::size_t block) const {
  constexpr std::size_t largest = std::numeric_limits<std::size_t>::max();
  std::size_t count = 1;
  for (const Axis& axis : blocks_[block]) {
    count = count > largest / axis.values.size() ? largest : count * axis.values.size();
  }
  return count;
}

std::vector<std::string> Combinations::varied() const {
  std::vector<std::string> varied;
  for (std::size_t i = 0; i < blocks_.front().size(); ++i) {
    const std::string& first = blocks_.front()[i].values.front();
    const auto differs = [&](const std::string& value) { return value != first; };
    const auto any_differs = [&](const Block& block) {
      return std::ranges::any_of(block[i].values, differs);
    };
    if (std::ranges::any_of(blocks_, any_differs)) varied.push_back(blocks_.front()[i].factor);
  }
  return varied;
}

// Returns the values of the factor `data`, or one empty value if the block has no such factor.
const std::vector<std::string>& Combinations::data_of(const Block& block) {
  static const std::vector<std::string> none{""};
  return block.empty() || block.front().factor != "data" ? none : block.front().values;
}

bool Combinations::has(const Block& block, const Configuration& configuration) {
  return std::ranges::all_of(block, [&](const Axis& axis) {
    return contains(axis.values, configuration.at(axis.factor));
  });
}

// Enumerates the combinations like an odometer: the last axis changes at every step.
void Combinations::for_each_of(const std::string& data, const Use& use) const {
  for (auto block = blocks_.begin(); block != blocks_.end(); ++block) {
    if (!contains(data_of(*block), data)) continue;
    Configuration configuration;
    for (const Axis& axis : *block) configuration[axis.factor] = axis.values.front();
    const std::size_t first = block->empty() || block->front().factor != "data" ? 0 : 1;
    if (first == 1) configuration["data"] = data;
    std::vector<std::size_t> place(block->size(), 0);
    for (std::size_t digit = first + 1; digit > first;) {
      const auto known = [&](const Block& before) { return has(before, configuration); };
      if (std::none_of(blocks_.begin(), block, known)) use(configuration);
      for (digit = block->size(); digit > first; --digit) {
        const Axis& axis = (*block)[digit - 1];
        std::size_t& at = place[digit - 1];
        at = at + 1 == axis.values.size() ? 0 : at + 1;
        configuration[axis.factor] = axis.values[at];
        if (at != 0) break;
      }
    }
  }
}

}  // namespace triptych::measure
