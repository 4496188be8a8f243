#include "judge/stress/stress.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <variant>

#include "accuracy/image_metrics.hpp"
#include "core/error.hpp"
#include "judge/agreement.hpp"
#include "judge/image_observation.hpp"
#include "judge/stress/expectation.hpp"

namespace triptych::judge {
namespace {

bool is_finite(const core::Image& image) {
  return !image.rgba.empty() &&
         std::ranges::all_of(image.rgba, [](float value) { return std::isfinite(value); }) &&
         // An infinite depth means that the pixel shows only background.
         std::ranges::none_of(image.depth, [](float value) { return std::isnan(value); });
}

// A case that is being scored.
struct Case {
  const record::Record* record = nullptr;
  StressScore score = {};
  std::optional<double> rmse = {};  // distance from the reference image, if an image was drawn
  core::Image bound = {};           // the bound on the error of the image
};

class StressScoring {
 public:
  StressScoring(const record::Store& store, const std::vector<record::Record>& records,
                const StressTruths& truths)
      : truths_(truths), run_(store, records) {
    for (const record::Record& record : records) {
      if (auto each = score_record(record)) cases_.push_back(std::move(*each));
    }
  }

  [[nodiscard]] std::vector<ScoredRecord> finish() && {
    std::map<std::string, std::vector<Case*>> by_configuration;
    for (Case& each : cases_) by_configuration[each.record->configuration].push_back(&each);
    for (const auto& [configuration, cases] : by_configuration) {
      for (Case* each : cases) judge_agreement(*each, cases);
    }
    std::vector<ScoredRecord> result;
    for (Case& each : cases_) result.push_back({each.record, std::move(each.score)});
    return result;
  }

 private:
  [[nodiscard]] std::vector<record::Expectation> expectations(const record::Record& record) const {
    return truths_.expectations ? truths_.expectations(record) : std::vector<record::Expectation>{};
  }

  // Scores a case, except for the point for agreement with other devices. Returns nullopt for a
  // case that is not scored, because the device does not support it.
  std::optional<Case> score_record(const record::Record& record) {
    Case result{&record};
    StressScore& score = result.score;
    const auto expected = expectations(record);
    if (record.outcome == record::Outcome::skipped) {
      const bool may_be_refused =
          std::ranges::any_of(expected, [](const record::Expectation& each) {
            return std::holds_alternative<record::MayBeRefused>(each.rule);
          });
      if (!may_be_refused) return std::nullopt;
      score.drawn = score.correct = score.agreed = true;
      return result;
    }
    const core::Image* image = nullptr;
    if (record.outcome != record::Outcome::measured) {
      score.lost_points.push_back(
          {.cause = Cause::ended, .outcome = record.outcome, .reason = record.reason});
    } else if (image = run_.image(record); image == nullptr) {
      score.lost_points.push_back({.cause = Cause::no_image});
    } else if (!is_finite(*image)) {
      score.lost_points.push_back({.cause = Cause::not_finite});
    } else {
      score.drawn = true;
      judge_image(*image, expected, result);
    }
    return result;
  }

  void judge_image(const core::Image& image, const std::vector<record::Expectation>& expected,
                   Case& result) {
    StressScore& score = result.score;
    TruthPair pair;
    try {
      pair = truths_.truth(*result.record);
    } catch (const core::Error& error) {
      score.lost_points.push_back({.cause = Cause::no_reference, .detail = error.what()});
      return;
    }
    const accuracy::ImageComparison comparison = accuracy::compare(image, pair.truth, pair.bound);
    Observation found = image_observation(comparison, image, pair.truth, Against::reference);
    score.correct = found.cause == Cause::within_bound;
    if (!score.correct) score.lost_points.push_back(std::move(found));
    for (const record::Expectation& each : expected) {
      if (truths_.part && !has_other_record(each, *result.record, run_)) continue;
      auto wrong = violation_of(each, *result.record, run_, truths_.truth);
      if (!wrong) continue;
      score.correct = false;
      score.lost_points.push_back(std::move(*wrong));
    }
    if (!comparison.size_mismatch) {
      result.rmse = accuracy::root_mean_square(image, pair.truth, pair.bound);
      result.bound = std::move(pair.bound);
    }
  }

  // Gives the point for agreement. If the images of two devices differ, only the device whose image
  // is closer to the reference image gets the point.
  void judge_agreement(Case& own, const std::vector<Case*>& cases) {
    if (!own.rmse) return;
    own.score.agreed = true;
    const core::Image& image = *run_.image(*own.record);
    for (const Case* other : cases) {
      if (other == &own || !other->rmse || !(*other->rmse <= *own.rmse)) continue;
      const double rms = accuracy::root_mean_square(image, *run_.image(*other->record), own.bound);
      if (rms < device_agreement) continue;
      own.score.agreed = false;
      own.score.lost_points.push_back({.cause = Cause::farther_device,
                                       .against = Against::other_devices,
                                       .numbers = {{"rms", rms},
                                                   {"allowed", device_agreement},
                                                   {"rmse", *own.rmse},
                                                   {"rmse_of_other", *other->rmse}},
                                       .facts = {{"other", other->record->device}}});
      return;
    }
  }

  const StressTruths& truths_;
  StressRun run_;
  std::vector<Case> cases_;
};

}  // namespace

std::vector<ScoredRecord> score_stress(const record::Store& store,
                                       const std::vector<record::Record>& records,
                                       const StressTruths& truths) {
  return StressScoring(store, records, truths).finish();
}

}  // namespace triptych::judge
