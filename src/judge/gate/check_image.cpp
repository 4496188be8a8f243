#include <algorithm>
#include <memory>
#include <tuple>

#include "accuracy/image_metrics.hpp"
#include "core/image_io.hpp"
#include "judge/agreement.hpp"
#include "judge/gate/run_view.hpp"
#include "judge/image_observation.hpp"
#include "record/factor_list.hpp"
#include "record/has_image.hpp"

namespace triptych::judge {
namespace {

// The largest allowed difference between two renderings of the same reference image, which differ
// only because their values are rounded to float.
constexpr double truth_tolerance = 1e-5;

// A correct image of one device, for the comparison with the images of other devices.
struct JudgedImage {
  const record::Record* record;
  core::Image image;
  double rmse;  // error against the reference image
};

// Returns whether the configuration sets only the scene and the technique, so that every device
// uses its default rendering path.
bool uses_default_path(const record::Record& record) {
  const auto scene = record::parse_factor_list(record.scene);
  const auto named = record::parse_factor_list(record.configuration);
  return std::ranges::all_of(named, [&](const auto& level) {
    return level.first == "technique" || scene.contains(level.first);
  });
}

class SceneJudge {
 public:
  SceneJudge(const RunView& view, ImageFindings& out, std::string scene)
      : view_(view), out_(out), scene_(std::move(scene)) {
    if (!view.baselines.present()) return;
    stored_ = view.baselines.image(scene_);
    reference_ = view.baselines.reference(scene_);
  }

  void judge(const record::Record& record) {
    if (record.image.empty()) {
      return add_undecided(record, {.cause = Cause::no_image}, {Advice::run_again});
    }
    TruthPair pair;
    try {
      pair = view_.request.truth(record);
    } catch (const core::Error& error) {
      return add_undecided(record, {.cause = Cause::no_reference, .detail = error.what()});
    }
    check_truth(pair);
    core::Image image;
    try {
      image = view_.store.decoded_image(record.image);
    } catch (const core::Error& error) {
      return add_undecided(record, {.cause = Cause::unreadable_image, .detail = error.what()});
    }
    judge_image(record, std::move(image), pair);
  }

  // Compares the images of different devices, and reports the two images that differ most. Call
  // this function after all records of the scene have been judged.
  void judge_agreement() {
    const JudgedImage* left = nullptr;
    const JudgedImage* right = nullptr;
    double largest = -1;
    for (std::size_t i = 0; i < images_.size(); ++i) {
      for (std::size_t j = i + 1; j < images_.size(); ++j) {
        if (images_[i].record->device == images_[j].record->device) continue;
        const double rms = accuracy::root_mean_square(images_[i].image, images_[j].image, bound_);
        if (!(rms > largest)) continue;
        std::tie(left, right, largest) = std::tuple(&images_[i], &images_[j], rms);
      }
    }
    if (left == nullptr) return;
    if (left->rmse > right->rmse) std::swap(left, right);
    report_agreement(*left, *right, largest);
  }

 private:
  void add_undecided(const record::Record& record, Observation observation,
                     AdviceWithCommand advice = {}) {
    out_.findings.push_back(finding_about(record, Check::image, Verdict::cannot_judge,
                                          std::move(observation), std::move(advice)));
  }

  void judge_image(const record::Record& record, core::Image image, const TruthPair& pair) {
    Observation observation = image_observation(accuracy::compare(image, pair.truth, pair.bound),
                                                image, pair.truth, Against::reference);
    if (observation.cause == Cause::within_bound && stored_) {
      Observation against_stored =
          image_observation(accuracy::compare(image, *stored_, pair.bound, truth_tolerance), image,
                            *stored_, Against::stored_image);
      if (against_stored.cause != Cause::within_bound) observation = std::move(against_stored);
    }
    const bool correct = observation.cause == Cause::within_bound;
    if (!correct) out_.wrong[{record.device, record.configuration}] = observation;
    out_.findings.push_back(finding_about(record, Check::image,
                                          correct ? Verdict::pass : Verdict::regression,
                                          std::move(observation)));
    if (correct && uses_default_path(record)) {
      const double rmse = accuracy::root_mean_square(image, pair.truth, pair.bound);
      images_.push_back({&record, std::move(image), rmse});
      if (!pair.bound.ids.empty()) bound_ = pair.bound;
    }
  }

  // Checks, once for each scene, whether the reference image has changed since it was accepted.
  void check_truth(const TruthPair& pair) {
    if (truth_checked_ || !view_.baselines.present()) return;
    truth_checked_ = true;
    Observation observation{.cause = Cause::reference_changed, .against = Against::stored_image};
    Verdict verdict = Verdict::regression;
    AdviceWithCommand advice;
    if (stored_) {
      Observation errors =
          image_observation(accuracy::compare(pair.truth, *stored_, truth_tolerance), pair.truth,
                            *stored_, Against::stored_image);
      observation.numbers = errors.numbers;
      // Ids and depths are compared only in pixels where rounding cannot change them.
      if (errors.cause == Cause::within_bound) {
        errors = image_observation(accuracy::compare(pair.truth, *stored_, pair.bound), pair.truth,
                                   *stored_, Against::stored_image);
      }
      if (errors.cause == Cause::within_bound) observation.cause = Cause::reference_as_stored;
      if (errors.cause != Cause::within_bound) observation.because.push_back(std::move(errors));
    } else if (reference_) {
      const bool same = is_same_reference(reference_hash(pair.truth), *reference_);
      if (same) observation.cause = Cause::reference_as_stored;
    } else {
      observation.cause = Cause::not_stored;
      verdict = Verdict::cannot_judge;
      advice = view_.accept_advice();
    }
    if (observation.cause == Cause::reference_as_stored) verdict = Verdict::pass;
    Finding finding = finding_about(view_, Check::image, verdict, std::move(observation), advice);
    finding.configuration = scene_;
    out_.findings.push_back(std::move(finding));
  }

  void report_agreement(const JudgedImage& nearer, const JudgedImage& farther, double rms) {
    const bool agree = rms < device_agreement;
    Finding finding = finding_about(
        *farther.record, Check::image, agree ? Verdict::pass : Verdict::regression,
        {.cause = agree ? Cause::devices_agree : Cause::devices_disagree,
         .against = Against::other_devices,
         .numbers = {{"allowed", device_agreement}},
         .facts = {{"other", nearer.record->device}, {"device", farther.record->device}}});
    finding.configuration = scene_;
    set_number(finding, "rms", rms);
    set_number(finding, "rmse", farther.rmse);
    set_number(finding, "rmse_of_other", nearer.rmse);
    out_.findings.push_back(std::move(finding));
  }

  const RunView& view_;
  ImageFindings& out_;
  std::string scene_;
  std::optional<core::Image> stored_;       // the accepted reference image, if it is stored
  std::optional<ReferenceHash> reference_;  // the hash of that image, if only the hash is stored
  bool truth_checked_ = false;
  std::vector<JudgedImage> images_;
  // The error bound of a particle scene. Its `ids` are flags: 0 means that rounding cannot change
  // which particle the pixel shows.
  core::Image bound_;
};

}  // namespace

ImageFindings check_images(const RunView& view) {
  ImageFindings out;
  if (!view.request.truth) {
    out.findings.push_back(
        finding_about(view, Check::image, Verdict::cannot_judge, {.cause = Cause::no_reference}));
    return out;
  }
  std::map<std::string, std::vector<const record::Record*>> scenes;
  for (const record::Record* record : view.measured) {
    if (record::has_image(*record)) scenes[record->scene].push_back(record);
  }
  for (const auto& [scene, records] : scenes) {
    SceneJudge judge(view, out, scene);
    for (const record::Record* record : records) judge.judge(*record);
    judge.judge_agreement();
  }
  return out;
}

}  // namespace triptych::judge
