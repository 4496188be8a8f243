#pragma once
// Synthetic timings of one gate, whose truth is known.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/random.hpp"
#include "judge/timing/model.hpp"
#include "tests/support/normal.hpp"

namespace triptych::judge {

// Trials of each rate that is tested.
inline constexpr int gates = 400;
inline constexpr double q = TimingModel::share_of_false_alarms;

// A gate's worth of synthetic timings. ln t = level of the configuration + what moved the whole run
// + noise of its own size per configuration.
struct Bench {
  std::size_t configurations = 60;
  std::size_t anchors = 0;
  int runs = 8;
  double noise = 0.01;   // standard deviation of ln t of a typical configuration
  double common = 0;     // of a whole run
  double now_shift = 0;  // of this run, device and all
  double slower_by = 1;  // factor on the planted configurations
  std::size_t planted = 0;
  double busier = 1;         // the noise of this run's rounds, in that of the stored runs
  bool knows_rounds = true;  // else it was of one round

  [[nodiscard]] std::vector<TimingCase> draw(std::uint64_t seed) const {
    core::Random random(seed);
    std::vector<double> moved;
    for (int run = 0; run < runs; ++run) moved.push_back(common * test::normal(random));
    const double moved_now = common * test::normal(random) + now_shift;
    std::vector<TimingCase> cases;
    for (std::size_t i = 0; i < configurations + anchors; ++i) {
      TimingCase timing;
      timing.device = "d";
      timing.anchor = i >= configurations;
      const double level = std::log(1e6) + 4 * random.uniform();
      const double own_noise = noise * std::exp(0.4 * test::normal(random));
      for (int run = 0; run < runs; ++run) {
        timing.stored_ns[fmt::format("run{}", run)] = std::exp(
            level + moved[static_cast<std::size_t>(run)] + own_noise * test::normal(random));
      }
      const double planted_shift = i < planted ? std::log(slower_by) : 0;
      std::vector<double> rounds;
      for (int round = 0; round < (busier > 1 ? 4 : 1); ++round) {
        rounds.push_back(std::exp(level + moved_now + planted_shift +
                                  busier * own_noise * test::normal(random)));
      }
      timing.median_ns = std::ranges::min(rounds);
      if (knows_rounds) timing.variance_of_rounds = variance_of_rounds(rounds);
      timing.tolerance = std::log(TimingModel::tolerated);
      cases.push_back(std::move(timing));
    }
    return cases;
  }
};

}  // namespace triptych::judge
