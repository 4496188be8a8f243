#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <tuple>

#include "accuracy/image_fault.hpp"
#include "accuracy/image_metrics.hpp"
#include "core/image_io.hpp"
#include "judge/agreement.hpp"
#include "judge/gate/run_view.hpp"
#include "record/factor_list.hpp"
#include "record/has_picture.hpp"

namespace triptych::judge {
namespace {

// Two renderings of one truth differ only by rounding to float.
constexpr double truth_tolerance = 1e-5;

// A device's picture that can be held against another device's.
struct Picture {
  const record::Record* record;
  core::Image image;
  double rmse;  // from the truth
};

void add_numbers(Finding& finding, const accuracy::ImageComparison& comparison) {
  set_number(finding, "max_error", comparison.largest.error);
  set_number(finding, "error", comparison.worst.error);
  set_number(finding, "bound", comparison.worst.bound);
  set_number(finding, "ratio", comparison.worst.ratio);
  set_number(finding, "x", comparison.worst.x);
  set_number(finding, "y", comparison.worst.y);
  set_number(finding, "rmse", comparison.rmse);
  set_number(finding, "error_99", comparison.error_99);
  set_number(finding, "pixels_over", static_cast<double>(comparison.over_bound));
  set_number(finding, "pixels_not_finite", static_cast<double>(comparison.non_finite));
  set_number(finding, "pixels_of_another_particle", static_cast<double>(comparison.wrong_ids));
  set_number(finding, "pixels_at_another_depth", static_cast<double>(comparison.wrong_depths));
}

// Nothing but the scene and the technique is set: every device takes the path it prefers.
bool on_default_path(const record::Record& record) {
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
      out_.findings.push_back(finding_about(record, Check::image, Verdict::cannot_judge,
                                            "the record holds no picture; run the plan again"));
      return;
    }
    TruthPair pair;
    try {
      pair = view_.request.truth(record);
    } catch (const core::Error& error) {
      out_.findings.push_back(finding_about(record, Check::image, Verdict::cannot_judge,
                                            fmt::format("no truth to judge by: {}", error.what())));
      return;
    }
    check_truth(pair);
    core::Image image;
    try {
      image = view_.store.picture(record.image);
    } catch (const core::Error& error) {
      out_.findings.push_back(
          finding_about(record, Check::image, Verdict::cannot_judge,
                        fmt::format("the store's picture cannot be read: {}", error.what())));
      return;
    }
    judge_image(record, std::move(image), pair);
  }

  // Between devices, once every record of the scene was judged.
  void judge_agreement() {
    const Picture* left = nullptr;
    const Picture* right = nullptr;
    double largest = -1;
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      for (std::size_t j = i + 1; j < pictures_.size(); ++j) {
        if (pictures_[i].record->device == pictures_[j].record->device) continue;
        const double rms =
            accuracy::root_mean_square(pictures_[i].image, pictures_[j].image, bound_);
        if (!(rms > largest)) continue;
        std::tie(left, right, largest) = std::tuple(&pictures_[i], &pictures_[j], rms);
      }
    }
    if (left == nullptr) return;
    if (left->rmse > right->rmse) std::swap(left, right);
    report_agreement(*left, *right, largest);
  }

 private:
  void judge_image(const record::Record& record, core::Image image, const TruthPair& pair) {
    const accuracy::ImageComparison comparison = accuracy::compare(image, pair.truth, pair.bound);
    std::string wrong = accuracy::image_fault(comparison, image, pair.truth, "the truth");
    if (wrong.empty() && stored_) {
      const auto against_stored = accuracy::compare(image, *stored_, pair.bound, truth_tolerance);
      wrong = accuracy::image_fault(against_stored, image, *stored_, "the stored picture");
    }
    const bool right = wrong.empty();
    Finding finding = finding_about(
        record, Check::image, right ? Verdict::pass : Verdict::regression,
        right ? "within the bound of the truth; " + accuracy::describe(comparison) : wrong);
    add_numbers(finding, comparison);
    out_.findings.push_back(std::move(finding));
    if (!right) out_.wrong[{record.device, record.configuration}] = wrong;
    if (right && on_default_path(record)) {
      const double rmse = accuracy::root_mean_square(image, pair.truth, pair.bound);
      pictures_.push_back({&record, std::move(image), rmse});
      if (!pair.bound.ids.empty()) bound_ = pair.bound;
    }
  }

  // Once per scene: is the truth the one that was accepted?
  void check_truth(const TruthPair& pair) {
    if (truth_checked_ || !view_.baselines.present()) return;
    truth_checked_ = true;
    Finding finding = finding_about(view_, Check::image, Verdict::pass, {});
    finding.configuration = scene_;
    if (stored_) {
      const accuracy::ImageComparison comparison =
          accuracy::compare(pair.truth, *stored_, truth_tolerance);
      add_numbers(finding, comparison);
      std::string wrong = accuracy::image_fault(comparison, pair.truth, *stored_, "the stored one");
      if (wrong.empty()) {  // ids and depths, where they are certain
        wrong = accuracy::image_fault(accuracy::compare(pair.truth, *stored_, pair.bound),
                                      pair.truth, *stored_, "the stored one");
      }
      finding.verdict = wrong.empty() ? Verdict::pass : Verdict::regression;
      finding.message = wrong.empty()
                            ? fmt::format("the truth is the stored one; largest difference {:.3g}",
                                          comparison.largest.error)
                            : "the scene or the truth changed: " + wrong;
    } else if (reference_) {
      const bool same = is_same_reference(reference_hash(pair.truth), *reference_);
      finding.verdict = same ? Verdict::pass : Verdict::regression;
      finding.message = same ? "the truth has the stored hash"
                             : "the scene or the truth changed: drawn now, it has another hash "
                               "than was accepted";
    } else {
      finding.verdict = Verdict::cannot_judge;
      finding.message = "nothing is stored of this scene; accept it: " + view_.accept_command();
    }
    out_.findings.push_back(std::move(finding));
  }

  void report_agreement(const Picture& nearer, const Picture& farther, double rms) {
    const bool agree = rms < device_agreement;
    std::string message =
        fmt::format("{} and {} differ most on their default paths: RMS {:.3g}, allowed {:.3g}",
                    nearer.record->device, farther.record->device, rms, device_agreement);
    if (!agree) {
      message += fmt::format(
          "; {} is farther from the truth (RMSE {:.3g}, {} {:.3g}), both within their bounds",
          farther.record->device, farther.rmse, nearer.record->device, nearer.rmse);
    }
    Finding finding =
        finding_about(*farther.record, Check::image, agree ? Verdict::pass : Verdict::regression,
                      std::move(message));
    finding.configuration = scene_;
    set_number(finding, "rms", rms);
    set_number(finding, "allowed", device_agreement);
    set_number(finding, "rmse", farther.rmse);
    set_number(finding, "rmse_of_other", nearer.rmse);
    out_.findings.push_back(std::move(finding));
  }

  const RunView& view_;
  ImageFindings& out_;
  std::string scene_;
  std::optional<core::Image> stored_;       // the reference, where the picture is kept
  std::optional<ReferenceHash> reference_;  // where it is not
  bool truth_checked_ = false;
  std::vector<Picture> pictures_;
  core::Image bound_;  // of a particle scene: says where ids are certain
};

}  // namespace

ImageFindings check_images(const RunView& view) {
  ImageFindings out;
  if (!view.request.truth) {
    out.findings.push_back(finding_about(view, Check::image, Verdict::cannot_judge,
                                         "there is no truth to judge pictures by"));
    return out;
  }
  std::map<std::string, std::vector<const record::Record*>> scenes;
  for (const record::Record* record : view.measured) {
    if (record::has_picture(*record)) scenes[record->scene].push_back(record);
  }
  for (const auto& [scene, records] : scenes) {
    SceneJudge judge(view, out, scene);
    for (const record::Record* record : records) judge.judge(*record);
    judge.judge_agreement();
  }
  return out;
}

}  // namespace triptych::judge
