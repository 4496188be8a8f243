#include "judge/stress/stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <variant>

#include "accuracy/image_fault.hpp"
#include "accuracy/image_metrics.hpp"
#include "core/error.hpp"
#include "judge/agreement.hpp"
#include "judge/stress/expectation.hpp"

namespace triptych::judge {
namespace {

void lose(StressScore& score, const std::string& why) {
  if (!score.lost.empty()) score.lost += "; ";
  score.lost += why;
}

bool is_finite(const core::Image& image) {
  return !image.rgba.empty() &&
         std::ranges::all_of(image.rgba, [](float value) { return std::isfinite(value); }) &&
         // Infinitely far is where nothing is.
         std::ranges::none_of(image.depth, [](float value) { return std::isnan(value); });
}

// A case under way: of what was drawn, how far it is from the truth.
struct Case {
  const record::Record* record = nullptr;
  StressScore score = {};
  std::optional<double> rmse = {};
  core::Image bound = {};  // of what was drawn
};

class Scoring {
 public:
  Scoring(const record::Store& store, const std::vector<record::Record>& records,
          const StressTruths& truths)
      : truths_(truths), run_(store, records) {
    for (const record::Record& record : records) {
      if (auto each = first_points(record)) cases_.push_back(std::move(*each));
    }
  }

  [[nodiscard]] std::vector<StressScored> finish() && {
    std::map<std::string, std::vector<Case*>> by_configuration;
    for (Case& each : cases_) by_configuration[each.record->configuration].push_back(&each);
    for (const auto& [configuration, cases] : by_configuration) {
      for (Case* each : cases) judge_agreement(*each, cases);
    }
    std::vector<StressScored> result;
    for (Case& each : cases_) result.push_back({each.record, std::move(each.score)});
    return result;
  }

 private:
  [[nodiscard]] std::vector<record::Expectation> expectations(const record::Record& record) const {
    return truths_.expectations ? truths_.expectations(record) : std::vector<record::Expectation>{};
  }

  // Nothing of a case that the device cannot be asked for.
  std::optional<Case> first_points(const record::Record& record) {
    Case result{&record};
    StressScore& score = result.score;
    const auto expected = expectations(record);
    if (record.outcome == record::Outcome::skipped) {
      const bool refusable = std::ranges::any_of(expected, [](const record::Expectation& each) {
        return std::holds_alternative<record::MayBeRefused>(each.rule);
      });
      if (!refusable) return std::nullopt;
      score.drawn = score.right = score.agreed = true;
      return result;
    }
    const core::Image* picture = nullptr;
    if (record.outcome != record::Outcome::measured) {
      lose(score, fmt::format("{}: {}", name_of(record.outcome), record.reason));
    } else if (picture = run_.picture(record); picture == nullptr) {
      lose(score, "there is no picture");
    } else if (!is_finite(*picture)) {
      lose(score, "the picture is not finite");
    } else {
      score.drawn = true;
      judge_picture(*picture, expected, result);
    }
    return result;
  }

  void judge_picture(const core::Image& picture, const std::vector<record::Expectation>& expected,
                     Case& result) {
    StressScore& score = result.score;
    TruthPair pair;
    try {
      pair = truths_.truth(*result.record);
    } catch (const core::Error& error) {
      lose(score, fmt::format("no truth to judge by: {}", error.what()));
      return;
    }
    const accuracy::ImageComparison comparison = accuracy::compare(picture, pair.truth, pair.bound);
    std::string wrong = accuracy::image_fault(comparison, picture, pair.truth, "the truth");
    score.right = wrong.empty();
    if (!score.right) lose(score, wrong);
    for (const record::Expectation& each : expected) {
      if (truths_.part && !has_other(each, *result.record, run_)) continue;
      wrong = unmet(each, *result.record, run_, truths_.truth);
      if (wrong.empty()) continue;
      score.right = false;
      lose(score, wrong);
    }
    if (!comparison.size_mismatch) {
      result.rmse = accuracy::root_mean_square(picture, pair.truth, pair.bound);
      result.bound = std::move(pair.bound);
    }
  }

  // Of two that differ the one nearer to the truth keeps its point.
  void judge_agreement(Case& own, const std::vector<Case*>& cases) {
    if (!own.rmse) return;
    own.score.agreed = true;
    const core::Image& mine = *run_.picture(*own.record);
    for (const Case* other : cases) {
      if (other == &own || !other->rmse || !(*other->rmse <= *own.rmse)) continue;
      const double rms = accuracy::root_mean_square(mine, *run_.picture(*other->record), own.bound);
      if (rms < device_agreement) continue;
      own.score.agreed = false;
      lose(own.score,
           fmt::format("differs from {} by RMS {:.3g}, allowed {:.3g}, and is the "
                       "farther from the truth (RMSE {:.3g}, {:.3g})",
                       other->record->device, rms, device_agreement, *own.rmse, *other->rmse));
      return;
    }
  }

  const StressTruths& truths_;
  StressRun run_;
  std::vector<Case> cases_;
};

}  // namespace

std::vector<StressScored> score_stress(const record::Store& store,
                                       const std::vector<record::Record>& records,
                                       const StressTruths& truths) {
  return Scoring(store, records, truths).finish();
}

}  // namespace triptych::judge
