#pragma once
// Run time against error: what a configuration's picture is off from the limit that its scene tends
// to, what that cost, at which order the error falls, and which configurations are worth having.
// Numbers only; where they come from is accuracy/cases.hpp.

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
  std::optional<double> time_ns;              // median of the timed frames, where there were any
  std::optional<std::uint64_t> samples;       // taken, where they were counted
  std::optional<std::uint64_t> instructions;  // of a frame, where they were counted
  std::optional<std::uint64_t> fetched;       // bytes, past a simulated cache
  std::optional<std::uint64_t> memory;        // bytes held on the device, where they were told
  std::optional<double> joules;               // of a frame, by all meters, where any told it
  double rmse = 0;                            // against the limit
  double largest = 0;
  double error_99 = 0;  // 99th percentile of the pixels' largest error
  // rmse split by the truth on the same sample lattice: limit – that truth, and that truth –
  // picture: rounding, voxel storage, filtering, early termination.
  double lattice = 0;
  double arithmetic = 0;
};

// In voxels; nullopt for what has no step.
[[nodiscard]] std::optional<double> step_of(const AccuracyCase& each);

// Error ∝ stepᵖ.
struct StepError {
  double step = 0;
  double error = 0;
  double arithmetic = 0;  // of the error, what no step removes
};
struct Order {
  double order = 0;
  double half_width = 0;   // of the 95 % confidence interval
  std::size_t points = 0;  // that the fit rests on
};

// The least-squares slope of ln error over ln step with Student's interval, over the points that
// show the asymptotic range:
//   step ≤ 1: between planes of voxel centres the field is one polynomial; a longer step skips
//     whole pieces and is no refinement of anything;
//   arithmetic ≤ error/10: by the triangle inequality ln error is then within 0.11 of the step's
//     own part, and within 0.005 where the two are uncorrelated, as rounding is.
// nullopt for fewer than three such points: the error is rounding, or too little was measured.
[[nodiscard]] std::optional<Order> fit_order(std::span<const StepError> points);

// The indices that no other one beats in cost and error both, by rising cost; of equals the first.
// What has no cost is not among them. Without `cost_of`: by time.
using CostOf = std::function<std::optional<double>(const AccuracyCase&)>;
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const AccuracyCase> cases,
                                                    const CostOf& cost_of);
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const AccuracyCase> cases);

// For each configuration off the front the one on it that beats it on both axes, the fastest.
struct Dominated {
  std::size_t index = 0;
  std::size_t by = 0;
};
[[nodiscard]] std::vector<Dominated> dominated(std::span<const AccuracyCase> cases,
                                               std::span<const std::size_t> front,
                                               const CostOf& cost_of);
[[nodiscard]] std::vector<Dominated> dominated(std::span<const AccuracyCase> cases,
                                               std::span<const std::size_t> front);

// Configurations that differ by `step` alone, by falling step.
struct AccuracyFamily {
  std::string name;  // "ert=0, voxel=f32": the factors that tell it from the scene's others
  std::vector<std::size_t> members;
  std::optional<Order> order;
};
// Without a factor `step` every configuration is a family of its own.
[[nodiscard]] std::vector<AccuracyFamily> accuracy_families(std::span<const AccuracyCase> cases);

// The least cost of reaching an error: a configuration's at or below it, or that of the point
// between two neighbours of a family, straight on two logarithmic axes. nullopt: none gets there.
[[nodiscard]] std::optional<double> cost_to_error(std::span<const AccuracyCase> cases,
                                                  std::span<const AccuracyFamily> families,
                                                  const CostOf& cost_of, double error);
[[nodiscard]] std::optional<double> time_to_error(std::span<const AccuracyCase> cases,
                                                  std::span<const AccuracyFamily> families,
                                                  double error);

// The most accurate, of equals the fastest, of those without a time the first.
[[nodiscard]] std::size_t most_accurate(std::span<const AccuracyCase> cases);

// One factor of a case set to another level, all others as they are.
struct Switched {
  std::string factor;
  std::size_t from = 0;
  std::size_t to = 0;
};
// By factor: of the most accurate case that has one, every case that differs by it alone. Plans do
// not make all combinations, so that it need not be the same case for every factor.
[[nodiscard]] std::vector<Switched> switched_alone(std::span<const AccuracyCase> cases);
// The same by `factor` between two pictures, each against its own limit: the most accurate case of
// the one that has a like one among `others`, and that; nullopt where none has.
[[nodiscard]] std::optional<Switched> switched_picture(std::span<const AccuracyCase> cases,
                                                       std::span<const AccuracyCase> others,
                                                       std::string_view factor);

// The errors of which people ask what they cost: one and a quarter step of 8 bits, and 1e-4.
inline constexpr double accuracy_goals[]{1.0 / 255, 1.0 / 1024, 1e-4};

}  // namespace triptych::accuracy
