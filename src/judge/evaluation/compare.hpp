#pragma once
// `triptych compare` on stored block differences: the same looks and the same confirmation, on
// families of configurations put together from what was measured.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "judge/evaluation/evaluation.hpp"

namespace triptych::judge {

// One launch of both workers, one configuration: side b with this much planted, side a without.
struct BlockSeries {
  std::string plan;
  std::string configuration;
  std::map<std::string, std::string> factors;
  std::string device;
  double percent = 0;               // planted; 0: A/A
  int launch = 0;                   // series of one launch shared their workers
  double seconds = 0;               // preparing and drawing
  std::vector<double> differences;  // d of each block, in order (measure/turns.hpp)
};

struct ReplayDesign {
  SequentialDesign looks = SequentialDesign::standard();
  ConfirmationDesign confirmation;  // launches: as many as there are where there are fewer
};

// `trials` of every kind for each device and plan. In each trial every configuration is given
// launches of its own at random – one for the looks, others to confirm – in their blocks' own
// order: blocks of one launch are no substitute for launches. Looks beyond the blocks of a launch
// are not made, as if the budget had ended. Deterministic in the series, the number and the seed.
[[nodiscard]] Tallies evaluate_comparison(std::span<const BlockSeries> series, std::size_t trials,
                                          std::uint64_t seed, const ReplayDesign& design = {});

}  // namespace triptych::judge
