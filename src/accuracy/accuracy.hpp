#pragma once
// Run time against error. A configuration's error is measured against the limit of its scene. This
// file computes orders of convergence and the configurations on the Pareto front from numbers only;
// accuracy/cases.hpp collects the numbers.

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
  std::optional<std::uint64_t> instructions;  // per frame, if they were counted
  std::optional<std::uint64_t> fetched;       // bytes that missed a simulated cache
  std::optional<std::uint64_t> memory;        // bytes on the device, if they were reported
  std::optional<double> joules;               // per frame, over all meters, if any reported it
  double rmse = 0;                            // against the limit
  double largest = 0;
  double error_99 = 0;  // 99th percentile of the pixels' largest error
  // rmse is split into two parts by the reference image at the device's sample positions. `lattice`
  // is the difference between the limit and that reference image. `arithmetic` is the difference
  // between the reference image and the device's image, which is caused by rounding, voxel storage,
  // filtering and early termination.
  double lattice = 0;
  double arithmetic = 0;
};

// The step in voxels; nullopt if there is none.
[[nodiscard]] std::optional<double> step_of(const AccuracyCase& each);

// A point of a fit of error ∝ stepᵖ.
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
//   - step ≤ 1: between planes of voxel centres, the field is one polynomial. A longer step skips
//     whole pieces, so shortening it is not a refinement.
//   - arithmetic ≤ error/10: by the triangle inequality, ln error is then within 0.11 of the part
//     that the step causes, and within 0.005 if the two parts are uncorrelated, as rounding errors
//     are.
// Returns nullopt for fewer than three such points, because then the error is mainly rounding, or
// too few steps were measured.
[[nodiscard]] std::optional<Order> fit_order(std::span<const StepError> points);

// The indices of the cases that no other case beats in both cost and error, sorted by cost; of
// equal cases, only the first is included. Cases without a cost are left out. Without `cost_of`,
// the cost is the time.
using CostOf = std::function<std::optional<double>(const AccuracyCase&)>;
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const AccuracyCase> cases,
                                                    const CostOf& cost_of);
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const AccuracyCase> cases);

// For a configuration that is not on the front, the fastest one on the front that beats it in both.
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
  std::string name;  // such as "ert=0, voxel=f32": the factors that differ in its scene
  std::vector<std::size_t> members;
  std::optional<Order> order;
};
// Groups the cases into families. Without a factor `step`, every configuration is a family of its
// own.
[[nodiscard]] std::vector<AccuracyFamily> accuracy_families(std::span<const AccuracyCase> cases);

// The smallest cost of reaching an error. It is the cost of a configuration whose error is not
// larger, or that of a point between two neighbours of a family, on a straight line in logarithmic
// axes. nullopt if no configuration reaches the error.
[[nodiscard]] std::optional<double> cost_to_error(std::span<const AccuracyCase> cases,
                                                  std::span<const AccuracyFamily> families,
                                                  const CostOf& cost_of, double error);
[[nodiscard]] std::optional<double> time_to_error(std::span<const AccuracyCase> cases,
                                                  std::span<const AccuracyFamily> families,
                                                  double error);

// The most accurate case. Of equally accurate ones, this is the fastest, or the first if none has a
// time.
[[nodiscard]] std::size_t most_accurate(std::span<const AccuracyCase> cases);

// A pair of cases that differ in one factor only.
struct Switched {
  std::string factor;
  std::size_t from = 0;
  std::size_t to = 0;
};
// For each factor, finds the most accurate case for which another case differs only in this factor,
// and all such other cases. The most accurate case may be a different one for every factor, because
// plans do not contain all combinations.
[[nodiscard]] std::vector<Switched> switched_alone(std::span<const AccuracyCase> cases);
// The same for `factor` between two images, each of which is compared with its own limit: the most
// accurate of `cases` that has a corresponding case among `others`, and that case. nullopt if there
// is none.
[[nodiscard]] std::optional<Switched> switched_picture(std::span<const AccuracyCase> cases,
                                                       std::span<const AccuracyCase> others,
                                                       std::string_view factor);

// The errors for which the cost is reported: one step and a quarter step of 8 bits, and 1e-4.
inline constexpr double accuracy_goals[]{1.0 / 255, 1.0 / 1024, 1e-4};

}  // namespace triptych::accuracy
