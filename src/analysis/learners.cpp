#include "analysis/learners.hpp"

#include <opencv2/ml.hpp>

#include "core/error.hpp"
#include "estimation/statistics.hpp"

namespace triptych::analysis {

using estimation::mean;
namespace {

int as_int(std::size_t value) {
  return static_cast<int>(value);
}

void check_sizes(const Features& features, std::span<const double> targets) {
  if (features.empty() || features.size() != targets.size()) {
    throw core::InputError("a model wants as many rows as targets, and at least one");
  }
}

cv::Mat single_row(std::span<const double> features) {
  cv::Mat row(1, as_int(features.size()), CV_32F);
  for (std::size_t i = 0; i < features.size(); ++i) {
    row.at<float>(0, as_int(i)) = static_cast<float>(features[i]);
  }
  return row;
}

}  // namespace

LinearModel::LinearModel(const Features& features, std::span<const double> targets) {
  check_sizes(features, targets);
  const std::size_t width = features.front().size();
  cv::Mat design(as_int(features.size()), as_int(width + 1), CV_64F);
  cv::Mat wanted(as_int(features.size()), 1, CV_64F);
  for (std::size_t i = 0; i < features.size(); ++i) {
    for (std::size_t j = 0; j < width; ++j) {
      design.at<double>(as_int(i), as_int(j)) = features[i][j];
    }
    design.at<double>(as_int(i), as_int(width)) = 1;
    wanted.at<double>(as_int(i)) = targets[i];
  }
  // Columns of one magnitude, so that the singular values tell dependence and not units.
  std::vector<double> scale(width + 1, 1.0);
  for (std::size_t j = 0; j < width; ++j) {
    const double norm = cv::norm(design.col(as_int(j)));
    if (norm > 0) scale[j] = norm;
    design.col(as_int(j)) /= scale[j];
  }
  cv::Mat solution;
  cv::solve(design, wanted, solution, cv::DECOMP_SVD);
  for (std::size_t j = 0; j <= width; ++j) {
    coefficients_.push_back(solution.at<double>(as_int(j)) / scale[j]);
  }
}

double LinearModel::predict(std::span<const double> features) const {
  double sum = coefficients_.back();
  for (std::size_t j = 0; j + 1 < coefficients_.size(); ++j) sum += coefficients_[j] * features[j];
  return sum;
}

namespace {

// The library draws from one generator per thread: it starts here at a state of ours and goes on
// afterwards as if nothing had been drawn.
class SeededDraws {
 public:
  SeededDraws() : before_(cv::theRNG()) { cv::theRNG() = cv::RNG(1); }
  ~SeededDraws() { cv::theRNG() = before_; }
  SeededDraws(const SeededDraws&) = delete;
  SeededDraws& operator=(const SeededDraws&) = delete;

 private:
  cv::RNG before_;
};

}  // namespace

struct Forest::State {
  cv::Ptr<cv::ml::RTrees> trees = cv::ml::RTrees::create();
};

Forest::Forest(const Features& features, const std::vector<bool>& categorical,
               std::span<const double> targets, const ForestOptions& options)
    : state_(std::make_unique<State>()) {
  check_sizes(features, targets);
  const std::size_t width = features.front().size();
  cv::Mat samples(0, as_int(width), CV_32F);
  cv::Mat responses(as_int(targets.size()), 1, CV_32F);
  for (std::size_t i = 0; i < features.size(); ++i) {
    samples.push_back(single_row(features[i]));
    responses.at<float>(as_int(i)) = static_cast<float>(targets[i]);
  }
  cv::Mat kinds(as_int(width + 1), 1, CV_8U, cv::Scalar(cv::ml::VAR_ORDERED));
  for (std::size_t j = 0; j < width; ++j) {
    if (categorical[j]) kinds.at<unsigned char>(as_int(j)) = cv::ml::VAR_CATEGORICAL;
  }
  const SeededDraws seeded;
  cv::ml::RTrees& trees = *state_->trees;
  trees.setMaxDepth(options.depth);
  trees.setMinSampleCount(options.least_samples);
  trees.setRegressionAccuracy(0);
  trees.setActiveVarCount(0);  // √p
  trees.setTermCriteria({cv::TermCriteria::MAX_ITER, options.trees, 0});
  trees.train(cv::ml::TrainData::create(samples, cv::ml::ROW_SAMPLE, responses, cv::noArray(),
                                        cv::noArray(), cv::noArray(), kinds));
}

Forest::~Forest() = default;
Forest::Forest(Forest&&) noexcept = default;
Forest& Forest::operator=(Forest&&) noexcept = default;

double Forest::predict(std::span<const double> features) const {
  return static_cast<double>(state_->trees->predict(single_row(features)));
}

std::optional<double> r_squared(std::span<const double> values, std::span<const double> predicted) {
  const double centre = mean(values);
  double total = 0;
  double rest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    total += (values[i] - centre) * (values[i] - centre);
    rest += (values[i] - predicted[i]) * (values[i] - predicted[i]);
  }
  if (values.size() < 2 || !(total > 0)) return std::nullopt;
  return 1 - rest / total;
}

}  // namespace triptych::analysis
