#pragma once
// All combinations of the factors' values, in the order in which they are measured. They are
// generated one at a time and never stored.

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"
#include "measure/plan/shard.hpp"

namespace triptych::measure {

// The values of the factors in a plan, in their canonical spelling. A factor that is absent has its
// default.
using ValuesByFactor = std::map<std::string, std::vector<std::string>>;

// Returns the factors of the suite, sorted by the time that a change of their level takes, longest
// first. In the order of measurement, the first factors change least often.
[[nodiscard]] std::vector<const Factor*> slowest_first(const Suite& suite);

// Generates the combinations of one or more blocks of values, without duplicates. All combinations
// with one data set come before those with the next data set. The blocks are the plan's own values
// and the mappings under `also` (plan_yaml.hpp).
class Combinations {
 public:
  using Use = std::function<void(const Configuration&)>;

  // The suite must outlive this object.
  Combinations(const Suite& suite, const std::vector<ValuesByFactor>& blocks);

  // Calls `use` for each combination in the shard. Throws InputError for an invalid shard.
  void for_each(const Shard& shard, const Use& use) const;

  // Returns the number of combinations of a block, including combinations that also occur in other
  // blocks. Saturates at the largest value of the type.
  [[nodiscard]] std::size_t upper_bound_of(std::size_t block) const;

  // Returns the factors with more than one value.
  [[nodiscard]] std::vector<std::string> varied() const;

 private:
  // A factor and its values. The first axis of a block varies least often.
  struct Axis {
    std::string factor;
    std::vector<std::string> values;
  };
  using Block = std::vector<Axis>;

  [[nodiscard]] static const std::vector<std::string>& data_of(const Block& block);
  [[nodiscard]] static bool has(const Block& block, const Configuration& configuration);
  void for_each_of(const std::string& data, const Use& use) const;

  std::vector<Block> blocks_;
  // All data sets in order, or a single empty name if there is no factor `data`.
  std::vector<std::string> data_;
};

}  // namespace triptych::measure
