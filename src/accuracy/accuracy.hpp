#pragma once
// Run time against error: the error of each configuration's image against the limit of its scene,
// its cost, the order at which the error falls, and the configurations on the Pareto front. This
// file computes with numbers only; accuracy/cases.hpp collects them.

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

// One configuration on one device. Errors are differences of linear float RGBA in full scale.
struct AccuracyCase {
  std::string configuration;
  std::map<std::string, std::string> factors;
  std::optional<double> time_ns;              // median of the timed frames, if any were timed
  std::optional<std::uint64_t> samples;       // number of samples, if they were counted
  std::optional<std::uint64_t> instructions;  // per frame, if they were counted
  std::optional<std::uint64_t> fetched;       // bytes that missed a simulated cache
  std::optional<std::uint64_t> memory;        // bytes on the device, if they were reported
  std::optional<double> joules;               // per frame, by all meters, if any reported it
  double rmse = 0;                            // against the limit
  double largest = 0;
  double error_99 = 0;  // 99th percentile of the pixels' largest error
  // The reference image on the same sample positions splits rmse into two parts: `lattice` is the
  // difference between the limit and that reference image. `arithmetic` is the difference between
  // the reference image and the device's image: rounding, voxel storage, filtering, early
  // termination.
  double lattice = 0;
  double arithmetic = 0;
};

// The step in voxels; nullopt if there is none.
[[nodiscard]] std::optional<double> step_of(const AccuracyCase& each);

// Error ∝ stepᵖ.
struct StepError {
  double step = 0;
  double error = 0;
  double arithmetic = 0;  // the part of the error that remains for any step
};
struct Order {
  double order = 0;
  double half_width = 0;   // half the width of the 95 % confidence interval
  std::size_t points = 0;  // number of points in the fit
};

// The least-squares slope of ln error over ln step with Student's interval, for points in the
// asymptotic range:
//   - step ≤ 1: between planes of voxel centres the field is one polynomial. A longer step skips
//     whole pieces, so shortening it is not a refinement.
//   - arithmetic ≤ error/10: by the triangle inequality ln error is then within 0.11 of the step's
//     own part, and within 0.005 if the two are uncorrelated, as rounding is.
// nullopt for fewer than three such points, because then the error is rounding or too little was
// measured.
[[nodiscard]] std::optional<Order> fit_order(std::span<const StepError> points);

// The indices that no other one beats in both cost and error, sorted by cost; among equal ones the
// first. Cases without a cost are left out. Without `cost_of` the cost is the time.
using CostOf = std::function<std::optional<double>(const AccuracyCase&)>;
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const AccuracyCase> cases,
                                                    const CostOf& cost_of);
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const AccuracyCase> cases);

// For each configuration off the front, the fastest one on the front that beats it on both axes.
struct Dominated {
  std::size_t index = 0;
  std::size_t by = 0;
};
[[nodiscard]] std::vector<Dominated> dominated(std::span<const AccuracyCase> cases,
                                               std::span<const std::size_t> front,
                                               const CostOf& cost_of);
[[nodiscard]] std::vector<Dominated> dominated(std::span<const AccuracyCase> cases,
                                               std::span<const std::size_t> front);

// Configurations that differ only in `step`, sorted by falling step.
struct AccuracyFamily {
  std::string name;  // "ert=0, voxel=f32": the factors that distinguish it in its scene
  std::vector<std::size_t> members;
  std::optional<Order> order;
};
// Without a factor `step` every configuration is a family of its own.
[[nodiscard]] std::vector<AccuracyFamily> accuracy_families(std::span<const AccuracyCase> cases);

// The smallest cost of reaching an error: that of a configuration at or below it, or that of the
// point between two neighbours of a family, on a straight line in two logarithmic axes. nullopt if
// none reaches it.
[[nodiscard]] std::optional<double> cost_to_error(std::span<const AccuracyCase> cases,
                                                  std::span<const AccuracyFamily> families,
                                                  const CostOf& cost_of, double error);
[[nodiscard]] std::optional<double> time_to_error(std::span<const AccuracyCase> cases,
                                                  std::span<const AccuracyFamily> families,
                                                  double error);

// The most accurate case; among equal ones the fastest, and among those without a time the first.
[[nodiscard]] std::size_t most_accurate(std::span<const AccuracyCase> cases);

// One factor of a case changed to another level, with all others unchanged.
struct Switched {
  std::string factor;
  std::size_t from = 0;
  std::size_t to = 0;
};
// For each factor: the most accurate case for which there is a case that differs only in this
// factor, and all such cases. Plans do not contain all combinations, so it may be another case for
// every factor.
[[nodiscard]] std::vector<Switched> switched_alone(std::span<const AccuracyCase> cases);
// The same for `factor` between two images, each against its own limit: the most accurate of
// `cases` that has a corresponding case among `others`, and that one; nullopt if there is none.
[[nodiscard]] std::optional<Switched> switched_picture(std::span<const AccuracyCase> cases,
                                                       std::span<const AccuracyCase> others,
                                                       std::string_view factor);

// The errors whose cost users ask for: one step and a quarter step of 8 bits, and 1e-4.
inline constexpr double accuracy_goals[]{1.0 / 255, 1.0 / 1024, 1e-4};

}  // namespace triptych::accuracy
