#pragma once
// Evaluates run time against error. The error of a configuration is the deviation of its image from
// the limit image of the scene, which is the image for step → 0. The functions in this file compute
// orders of convergence and Pareto fronts from plain numbers, which accuracy/cases.hpp collects.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::accuracy {

// One configuration on one device. Errors are differences of linear float RGBA, where 1 is full
// scale.
struct AccuracyCase {
  std::string configuration;
  std::map<std::string, std::string> factors;
  std::optional<double> time_ns;              // median of the timed frames, if any were timed
  std::optional<std::uint64_t> samples;       // number of samples, if they were counted
  std::optional<std::uint64_t> instructions;  // instructions per frame, if they were counted
  std::optional<std::uint64_t> fetched;       // bytes per frame loaded into a simulated cache
  std::optional<std::uint64_t> memory;        // bytes allocated on the device, if reported
  std::optional<double> joules;               // energy per frame, if any meter reported it
  double rmse = 0;                            // root mean square deviation from the limit image
  double largest = 0;
  double error_99 = 0;  // 99th percentile, over the pixels, of the largest channel error
  // rmse has two components. `lattice` is the difference between the limit image and the reference
  // image, which is rendered at the device's sample positions. `arithmetic` is the difference
  // between the reference image and the device's image, which is caused by rounding, voxel storage,
  // filtering and early termination.
  double lattice = 0;
  double arithmetic = 0;
};

// Returns the step size in voxels, or nullopt if the configuration has no step.
[[nodiscard]] std::optional<double> step_of(const AccuracyCase& each);

// A data point for fitting error ∝ stepᵖ.
struct StepError {
  double step = 0;
  double error = 0;
  double arithmetic = 0;  // part of the error that does not depend on the step
};
struct Order {
  double order = 0;
  double half_width = 0;   // half the width of the 95 % confidence interval
  std::size_t points = 0;  // number of points in the fit
};

// Fits the least-squares slope of ln error over ln step, with Student's interval, to the points in
// the asymptotic range:
//   - step ≤ 1: between neighbouring planes of voxel centres, the field is a single polynomial. A
//     longer step skips entire polynomial pieces, so its error does not yet follow the order of
//     convergence.
//   - arithmetic ≤ error/10: by the triangle inequality, ln error then differs by at most 0.11 from
//     the logarithm of the part that is caused by the step, and by at most 0.005 if the two parts
//     are uncorrelated, as rounding errors are.
// Returns nullopt for fewer than three such points, because then the error is mainly rounding, or
// too few steps were measured.
[[nodiscard]] std::optional<Order> fit_order(std::span<const StepError> points);

// Returns the Pareto front: the indices of the cases that no other case beats in both cost and
// error, sorted by cost. If several cases are equal, only the first is included. Cases without a
// cost are left out. Without `cost_of`, the cost is the time.
using CostOf = std::function<std::optional<double>(const AccuracyCase&)>;
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const AccuracyCase> cases,
                                                    const CostOf& cost_of);
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const AccuracyCase> cases);

// A configuration that is not on the Pareto front, and the cheapest configuration on the front that
// beats it in both cost and error.
struct Dominated {
  std::size_t index = 0;
  std::size_t by = 0;
};
[[nodiscard]] std::vector<Dominated> dominated(std::span<const AccuracyCase> cases,
                                               std::span<const std::size_t> front,
                                               const CostOf& cost_of);
[[nodiscard]] std::vector<Dominated> dominated(std::span<const AccuracyCase> cases,
                                               std::span<const std::size_t> front);

// Configurations that differ only in `step`, sorted by decreasing step.
struct AccuracyFamily {
  std::string name;  // factors that differ between families, such as "ert=0, voxel=f32"
  std::vector<std::size_t> members;
  std::optional<Order> order;
};
// Groups the cases into families. If there is no factor `step`, every configuration forms its own
// family.
[[nodiscard]] std::vector<AccuracyFamily> accuracy_families(std::span<const AccuracyCase> cases);

// Returns the lowest cost at which the given error is reached, or nullopt if no configuration
// reaches this error. The result is either the cost of a configuration whose error is not larger,
// or a cost interpolated between two neighbours in a family, along a straight line on logarithmic
// axes.
[[nodiscard]] std::optional<double> cost_to_error(std::span<const AccuracyCase> cases,
                                                  std::span<const AccuracyFamily> families,
                                                  const CostOf& cost_of, double error);
[[nodiscard]] std::optional<double> time_to_error(std::span<const AccuracyCase> cases,
                                                  std::span<const AccuracyFamily> families,
                                                  double error);

// Returns the index of the most accurate case. If several cases are equally accurate, it is the
// fastest of them, or the first if none of them has a time.
[[nodiscard]] std::size_t most_accurate(std::span<const AccuracyCase> cases);

// A pair of cases that differ in one factor only.
struct FactorSwitch {
  std::string factor;
  std::size_t from = 0;
  std::size_t to = 0;
};
// For each factor, finds the most accurate case that has a counterpart, and all its counterparts. A
// counterpart is a case that differs only in this factor. The most accurate case may be a different
// one for every factor, because plans do not contain all combinations.
[[nodiscard]] std::vector<FactorSwitch> single_factor_switches(std::span<const AccuracyCase> cases);
// Like single_factor_switches(), but for a single factor that changes the image, so that `cases`
// and `others` have different limit images. Returns the most accurate of `cases` that has a
// counterpart in `others`, and this counterpart, or nullopt if there is none.
[[nodiscard]] std::optional<FactorSwitch> factor_switch_between(
    std::span<const AccuracyCase> cases, std::span<const AccuracyCase> others,
    std::string_view factor);

// The errors for which the cost is reported: one 8-bit step, about a quarter of that, and 1e-4.
inline constexpr double accuracy_goals[]{1.0 / 255, 1.0 / 1024, 1e-4};

}  // namespace triptych::accuracy
