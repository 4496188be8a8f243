#include "analysis/prediction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "analysis/learners.hpp"
#include "core/random.hpp"
#include "estimation/statistics.hpp"

namespace triptych::analysis {

using estimation::mean;
namespace {

// What decides the structure of what is drawn, in both suites.
constexpr std::array<std::string_view, 11> structure_factors{
    "adapt",     "camera",       "colour", "culling",          "data", "ert", "fov",
    "precision", "radius_scale", "skip",   "transfer_function"};

bool is_structure(const std::string& factor) {
  return std::ranges::find(structure_factors, factor) != structure_factors.end();
}

// "N" or "WxH" → pixels.
std::optional<double> pixels(const std::string& viewport) {
  const std::size_t cross = viewport.find('x');
  const auto width = number(std::string_view(viewport).substr(0, cross));
  const auto height =
      cross == std::string::npos ? width : number(std::string_view(viewport).substr(cross + 1));
  return width && height ? std::optional(*width * *height) : std::nullopt;
}

// Turns one factor into numbers; a category becomes its place among the levels.
class Encoder {
 public:
  Encoder(std::string factor, const Chosen& chosen) : factor_(std::move(factor)) {
    for (const Observation* each : chosen) levels_.push_back(each->factors.at(factor_));
    std::ranges::sort(levels_, natural_less);
    levels_.erase(std::ranges::unique(levels_).begin(), levels_.end());
    numeric_ = std::ranges::all_of(levels_, [&](const auto& level) { return bool(value(level)); });
  }
  [[nodiscard]] bool categorical() const { return !numeric_; }
  [[nodiscard]] std::string name() const {
    if (!numeric_) return factor_ + " (category)";
    if (factor_ == "viewport") return "viewport (pixels)";
    return factor_ == "step" ? "step (samples per voxel)" : factor_;
  }
  [[nodiscard]] double code(const Observation& observation) const {
    const std::string& level = observation.factors.at(factor_);
    return numeric_ ? *value(level) : static_cast<double>(place(level));
  }
  // Indicators of every level but the first, or the number.
  void append_indicators(const Observation& observation, std::vector<double>& row) const {
    if (numeric_) {
      row.push_back(code(observation));
      return;
    }
    const std::size_t mine = place(observation.factors.at(factor_));
    for (std::size_t i = 1; i < levels_.size(); ++i) row.push_back(i == mine ? 1 : 0);
  }

 private:
  [[nodiscard]] std::optional<double> value(const std::string& level) const {
    if (factor_ == "viewport") return pixels(level);
    const std::optional<double> number_of = number(level);
    if (factor_ == "step" && number_of) return 1 / *number_of;
    return number_of;
  }
  [[nodiscard]] std::size_t place(const std::string& level) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(levels_, level, natural_less) -
                                    levels_.begin());
  }

  std::string factor_;
  std::vector<std::string> levels_;
  bool numeric_ = false;
};

struct Division {
  Chosen trained, held_out;
};

Division divide(Chosen chosen, std::uint64_t seed) {
  core::Random random(seed);
  for (std::size_t i = chosen.size(); i > 1; --i) {
    std::swap(chosen[i - 1],
              chosen[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  }
  const auto cut = static_cast<std::ptrdiff_t>(train_share * static_cast<double>(chosen.size()));
  return {Chosen(chosen.begin(), chosen.begin() + cut), Chosen(chosen.begin() + cut, chosen.end())};
}

std::string structure_of(const Observation& observation) {
  std::string key;
  for (const auto& [factor, value] : observation.factors) {
    if (is_structure(factor)) key += factor + '=' + value + ',';
  }
  return key;
}

std::map<std::string, Chosen> by_structure(const Chosen& chosen) {
  std::map<std::string, Chosen> result;
  for (const Observation* each : chosen) result[structure_of(*each)].push_back(each);
  return result;
}

std::vector<double> times_of(const Chosen& chosen) {
  std::vector<double> times;
  for (const Observation* each : chosen) times.push_back(each->ms);
  return times;
}

// One linear model for the observations of one structure, with the features that vary there.
struct StructureModel {
  std::vector<Encoder> encoders;
  LinearModel model;

  [[nodiscard]] static std::vector<double> row(const std::vector<Encoder>& encoders,
                                               const Observation& observation) {
    std::vector<double> result;
    for (const Encoder& each : encoders) each.append_indicators(observation, result);
    return result;
  }
  [[nodiscard]] double predict(const Observation& observation) const {
    return model.predict(row(encoders, observation));
  }
  // Absent where there are too few training rows for the unknowns.
  [[nodiscard]] static std::optional<StructureModel> learn(const Chosen& trained,
                                                           const Chosen& held_out) {
    Chosen both = trained;
    both.insert(both.end(), held_out.begin(), held_out.end());
    std::vector<Encoder> encoders;
    for (const std::string& factor : scope_of(both).varied) {
      if (!is_structure(factor)) encoders.emplace_back(factor, both);
    }
    Features features;
    for (const Observation* each : trained) features.push_back(row(encoders, *each));
    if (features.empty() || features.size() < features.front().size() + 3) return std::nullopt;
    LinearModel model(features, times_of(trained));
    return StructureModel{std::move(encoders), std::move(model)};
  }
};

class EverythingModel {
 public:
  EverythingModel(const Chosen& all, const Chosen& trained)
      : encoders_(encoders_for(all)), forest_(learn(encoders_, trained)) {}
  [[nodiscard]] double predict(const Observation& observation) const {
    return forest_.predict(row(encoders_, observation));
  }

 private:
  static std::vector<Encoder> encoders_for(const Chosen& all) {
    std::vector<Encoder> encoders;
    for (const std::string& factor : scope_of(all).varied) encoders.emplace_back(factor, all);
    return encoders;
  }
  static std::vector<double> row(const std::vector<Encoder>& encoders,
                                 const Observation& observation) {
    std::vector<double> result;
    for (const Encoder& each : encoders) result.push_back(each.code(observation));
    return result;
  }
  static Forest learn(const std::vector<Encoder>& encoders, const Chosen& trained) {
    Features features;
    std::vector<bool> categorical;
    for (const Encoder& each : encoders) categorical.push_back(each.categorical());
    for (const Observation* each : trained) features.push_back(row(encoders, *each));
    return {features, categorical, times_of(trained)};
  }

  std::vector<Encoder> encoders_;
  Forest forest_;
};

struct Predicted {
  std::size_t models = 0;
  std::vector<double> times, line, forest;

  void append(const Predicted& other) {
    models += other.models;
    times.insert(times.end(), other.times.begin(), other.times.end());
    line.insert(line.end(), other.line.begin(), other.line.end());
    forest.insert(forest.end(), other.forest.begin(), other.forest.end());
  }
  [[nodiscard]] Score score(std::string data) const {
    return {std::move(data), models, times.size(), r_squared(times, line),
            r_squared(times, forest)};
  }
};

// Scores of every data set whose lines could be learned, then of all of them together.
void add_scores(Prediction& prediction, const std::map<std::string, Predicted>& by_data) {
  Predicted all;
  std::vector<double> lines;
  for (const auto& [data, predicted] : by_data) {
    prediction.scores.push_back(predicted.score(data));
    if (prediction.scores.back().line_r2) lines.push_back(*prediction.scores.back().line_r2);
    all.append(predicted);
  }
  prediction.scores.push_back(all.score("all"));
  if (lines.empty()) return;
  prediction.line_mean = mean(lines);
  prediction.line_least = std::ranges::min(lines);
  prediction.line_largest = std::ranges::max(lines);
}

Prediction described(const Chosen& all, const Division& division) {
  Prediction prediction{.trained = division.trained.size(),
                        .held_out = division.held_out.size(),
                        .scope = scope_of(all)};
  for (const std::string& factor : prediction.scope.varied) {
    if (is_structure(factor)) {
      prediction.structure.push_back(factor);
    } else {
      prediction.line_features.push_back(Encoder(factor, all).name());
    }
  }
  return prediction;
}

}  // namespace

PredictionOutcome predict(const Dataset& dataset, std::uint64_t seed) {
  const Chosen all = all_of(dataset);
  if (all.size() < least_for_prediction) {
    return {std::nullopt,
            fmt::format("{} observations, {} are needed", all.size(), least_for_prediction)};
  }
  const Division division = divide(all, seed);
  Prediction prediction = described(all, division);
  if (prediction.line_features.empty() && prediction.structure.empty()) {
    return {std::nullopt, "no factor varies"};
  }
  const EverythingModel everything(all, division.trained);
  const auto held_out = by_structure(division.held_out);
  const auto trained = by_structure(division.trained);
  std::map<std::string, Predicted> by_data;
  std::vector<double> all_times;
  std::vector<double> all_forest;
  for (const auto& [structure, rows] : held_out) {
    const auto to_learn = trained.find(structure);
    const auto model =
        to_learn == trained.end() ? std::nullopt : StructureModel::learn(to_learn->second, rows);
    ++prediction.structures;
    if (!model) ++prediction.structures_left_out;
    Predicted predicted{.models = 1};
    for (const Observation* each : rows) {
      const double by_forest = everything.predict(*each);
      all_times.push_back(each->ms);
      all_forest.push_back(by_forest);
      if (!model) continue;
      predicted.times.push_back(each->ms);
      predicted.line.push_back(model->predict(*each));
      predicted.forest.push_back(by_forest);
    }
    if (model) by_data[rows.front()->factors.at("data")].append(predicted);
  }
  prediction.forest_on_all = r_squared(all_times, all_forest);
  add_scores(prediction, by_data);
  return {std::move(prediction), {}};
}

}  // namespace triptych::analysis
