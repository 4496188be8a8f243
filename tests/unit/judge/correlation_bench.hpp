#pragma once
// Two synthetic devices, and what the correlation says of them. Every rate is counted over seeded
// trials; a bound leaves what a binomial count exceeds with a probability below 10⁻⁴, so that the
// seed decides nothing.

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/random.hpp"
#include "judge/correlation/model.hpp"
#include "tests/support/normal.hpp"

namespace triptych::judge {

struct CorrelationBench {
  double slope = 0.95;
  double noise = 0.05;           // ε, standard deviation in ln t
  double anchor_scatter = 0.02;  // of anchor techniques' ratios
  double wild = 0;               // share of configurations that differ by a factor e^±0.5
  int anchor_techniques = 5;
  double wild_anchor = 0;  // what the last technique's times scatter by from run to run
  int repeats = 1;         // 48 configurations each
  // What is planted on a configuration, in ln t_B.
  std::function<double(const CorrelationCase&)> planted = [](const CorrelationCase&) {
    return 0.0;
  };

  // 4 data × 3 cameras × 2 techniques × 2 skips, times over a factor of e^3.
  [[nodiscard]] std::vector<CorrelationCase> draw(std::uint64_t seed) const {
    core::Random random(seed);
    std::vector<CorrelationCase> cases;
    for (int i = 0; i < 48 * repeats; ++i) {
      CorrelationCase each;
      each.factors = {{"data", fmt::format("d{}", i % 4)},
                      {"camera", fmt::format("c{}", i / 4 % 3)},
                      {"technique", i / 12 % 2 == 0 ? "raycast" : "fragment"},
                      {"skip", i / 24 % 2 == 0 ? "none" : "bricks"},
                      {"viewport", "192"}};
      each.configuration = fmt::format("n={}", i);
      each.log_time_a = 14 + 3 * random.uniform();
      each.variance_a = 1e-5;
      each.variance_b = 1e-5;
      const double odd = random.uniform() < wild ? (random.uniform() < 0.5 ? -0.5 : 0.5) : 0;
      each.log_time_b =
          1 + slope * each.log_time_a + noise * test::normal(random) + odd + planted(each);
      cases.push_back(each);
    }
    for (int technique = 0; technique < anchor_techniques; ++technique) {
      const double launch_scatter = technique + 1 == anchor_techniques ? wild_anchor : 0;
      const double own = anchor_scatter * test::normal(random);
      for (int size = 1; size <= 2; ++size) {
        CorrelationCase each;
        each.anchor = true;
        each.factors = {{"technique", fmt::format("anchor_{}", technique)}};
        each.configuration = fmt::format("anchor={},{}", technique, size);
        each.log_time_a = 14.5 + technique * 0.3 + std::log(size);
        each.log_time_b = 1 + slope * each.log_time_a + own + 0.005 * test::normal(random);
        each.variance_b = launch_scatter * launch_scatter;
        if (launch_scatter > 0) each.log_time_b += launch_scatter * test::normal(random);
        cases.push_back(each);
      }
    }
    return cases;
  }
};

inline int count(const CorrelationBench& bench, int trials,
                 const std::function<bool(const Correlation&)>& what) {
  int found = 0;
  for (int seed = 1; seed <= trials; ++seed) {
    const Correlation result = correlate(bench.draw(static_cast<std::uint64_t>(seed)));
    found += what(result) ? 1 : 0;
  }
  return found;
}

// The most of `trials` that a true rate of `share` explains; at least, for `least`.
inline int most(int trials, double share) {
  return static_cast<int>(
      boost::math::quantile(boost::math::complement(boost::math::binomial(trials, share), 1e-4)));
}
inline int least(int trials, double share) {
  return static_cast<int>(boost::math::quantile(boost::math::binomial(trials, share), 1e-4));
}

inline bool any_configuration(const Correlation& result) {
  return std::ranges::any_of(result.judgements, &ConfigurationJudgement::slower);
}
inline bool any_level(const Correlation& result) {
  return std::ranges::any_of(result.levels, &LevelEffect::slower);
}

}  // namespace triptych::judge
