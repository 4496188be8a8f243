#pragma once
// Whether a camera path is representative of all views (sections 5.3 and 6.3 of the paper):
// two-sample Kolmogorov–Smirnov tests of its times against all, beside random subsets.

#include <string>
#include <vector>

#include "analysis/kolmogorov.hpp"
#include "analysis/splits.hpp"

namespace triptych::analysis {

// Random subsets of the same size, each tested against all. Subsets are part of all, hence closer
// to it than independent samples: their p-values lie above uniform.
struct SubsetTests {
  std::size_t subsets = 0, rejected = 0;  // at p < 0.05
  double d_mean = 0;
  double p_minimum = 0, p_mean = 0, p_median = 0, p_maximum = 0;
};

struct PathTest {
  std::string path;  // "orbit_y", "random", …
  std::size_t views = 0, samples = 0, all_views = 0, all_samples = 0;
  KsTest test;
  SubsetTests of_samples;  // as the paper: any times, of any view
  SubsetTests of_views;    // all times of as many views, chosen at random
  Scope scope;             // of all
};

inline constexpr std::size_t subset_count = 100;
inline constexpr double rejection_level = 0.05;

// Over the configurations that were measured from the most views. Empty when there is one path
// only.
[[nodiscard]] std::vector<PathTest> path_tests(const Dataset& dataset, std::uint64_t seed);

}  // namespace triptych::analysis
