#pragma once
// How times are distributed (the paper's Figures 3 and 10): histograms, percentiles, a log-normal
// fit and what a Kolmogorov–Smirnov test says of it.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/splits.hpp"

namespace triptych::analysis {

// ln t ~ N(mu, sigma²), by maximum likelihood: mean and standard deviation (÷ n) of ln t.
struct LogNormal {
  double mu = 0;
  double sigma = 0;
};
// Values > 0, at least one.
[[nodiscard]] LogNormal fit_log_normal(std::span<const double> values);

struct Bin {
  double from = 0, to = 0;  // ms
  std::size_t count = 0;
  double expected = 0;  // of the fit, in the same unit
};
// Equal bins over the range of the values, or of their logarithms. Their number is Freedman and
// Diaconis' (1981), 2·IQR·n^(−1/3) wide, at least 5 and at most 60.
[[nodiscard]] std::vector<Bin> histogram(std::span<const double> values, bool logarithmic,
                                         const LogNormal& fit);

struct Distribution {
  std::string of;     // "all", or "device=…"
  std::string clock;  // "device" or "wall"
  Scope scope;
  double mean = 0;                                  // ms, as all below
  std::vector<std::pair<int, double>> percentiles;  // 0, 5, 10, 25, 50, 75, 90, 95, 99, 100
  LogNormal fit;
  double ks_d = 0;
  // As the paper tests: as if the parameters had not been estimated from the same sample, hence
  // too large.
  double ks_p = 0;
  double lilliefors_p = 0;  // by parametric bootstrap: what the test is worth
  std::size_t replicates = 0;
  std::vector<Bin> linear, logarithmic;
};

inline constexpr std::size_t least_for_distribution = 8;

// Of all times and of each device's; of both clocks for all, where every record has both. Only
// those of at least `least_for_distribution` different times.
[[nodiscard]] std::vector<Distribution> distributions(const Dataset& dataset, std::uint64_t seed);

}  // namespace triptych::analysis
