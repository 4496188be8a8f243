#pragma once
// All combinations of factors' values, in the order in which they are measured, made one by one.

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"
#include "measure/plan/shard.hpp"

namespace triptych::measure {

// What a plan gives, each in its one spelling; a factor left out has its default.
using ValuesByFactor = std::map<std::string, std::vector<std::string>>;

// The suite's factors; those before vary more slowly.
[[nodiscard]] std::vector<const Factor*> slowest_first(const Suite& suite);

// Those of one block of values or more, none twice, one data set after the other.
class Combinations {
 public:
  using Use = std::function<void(const Configuration&)>;

  // The suite must live as long.
  Combinations(const Suite& suite, const std::vector<ValuesByFactor>& blocks);

  // Throws InputError for a shard that cannot be.
  void for_each(const Shard& shard, const Use& use) const;

  // How many there are at most of a block; the largest number where there are more.
  [[nodiscard]] std::size_t most_of(std::size_t block) const;

  // Factors with more than one value.
  [[nodiscard]] std::vector<std::string> varied() const;

 private:
  // A factor and its values; those before it vary more slowly.
  struct Axis {
    std::string factor;
    std::vector<std::string> values;
  };
  using Block = std::vector<Axis>;

  [[nodiscard]] static const std::vector<std::string>& data_of(const Block& block);
  [[nodiscard]] static bool has(const Block& block, const Configuration& configuration);
  void for_each_of(const std::string& data, const Use& use) const;

  std::vector<Block> blocks_;
  std::vector<std::string> data_;  // all data sets, in order; one without a name where none is told
};

}  // namespace triptych::measure
