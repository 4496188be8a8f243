#pragma once
// Two ways to learn times from features. The library behind them (OpenCV's) shows nowhere else.

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace triptych::analysis {

// Rows of equal length.
using Features = std::vector<std::vector<double>>;

// Ordinary least squares with an intercept; where features are linearly dependent, the solution of
// least norm.
class LinearModel {
 public:
  LinearModel(const Features& features, std::span<const double> targets);
  [[nodiscard]] double predict(std::span<const double> features) const;

 private:
  std::vector<double> coefficients_;  // of the features, then the intercept
};

struct ForestOptions {
  int trees = 200;
  int depth = 25;
  int least_samples = 2;  // a node with fewer is not divided
};

// Random forest regression (Breiman 2001): bootstrap samples, √p features tried at each node. The
// same input gives the same forest. Numbers are kept in single precision.
class Forest {
 public:
  // `categorical[i]`: feature i numbers categories, without order.
  Forest(const Features& features, const std::vector<bool>& categorical,
         std::span<const double> targets, const ForestOptions& options = {});
  ~Forest();
  Forest(Forest&&) noexcept;
  Forest& operator=(Forest&&) noexcept;
  Forest(const Forest&) = delete;
  Forest& operator=(const Forest&) = delete;
  [[nodiscard]] double predict(std::span<const double> features) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Coefficient of determination, 1 − Σ(y − ŷ)²/Σ(y − ȳ)²: 1 is perfect, 0 no better than the mean,
// less than 0 worse. Absent for fewer than two values or constant ones.
[[nodiscard]] std::optional<double> r_squared(std::span<const double> values,
                                              std::span<const double> predicted);

}  // namespace triptych::analysis
