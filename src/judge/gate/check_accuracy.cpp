// Measures the error of each image against its limit image (the image with exact ray integrals),
// and compares it with the accepted error.

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "judge/gate/run_view.hpp"
#include "record/has_image.hpp"

namespace triptych::judge {
namespace {

// The largest rounding error of a channel when an image is converted to floats.
constexpr double float_rounding = 0x1.0p-24;

// Returns the largest allowed error. A part of the accepted error (`arithmetic`) comes from
// rounding, storage and early ray termination. In another correct image, that part may have the
// opposite sign, so the error may exceed the accepted error by twice that part. This follows from
// the triangle inequality for the RMS distance: two correct images differ by at most the sum of
// their distances from the reference image.
double allowed_error(const StoredError& stored) {
  return stored.rmse + 2 * stored.arithmetic + float_rounding;
}

// Returns the largest allowed error on this device. If no error was accepted for this device,
// returns the largest error that is allowed on any device.
std::optional<double> allowed_error_on(const std::map<std::string, StoredError>& stored,
                                       const std::string& device) {
  const auto own = stored.find(device);
  if (own != stored.end()) return allowed_error(own->second);
  std::optional<double> largest;
  for (const auto& [other, error] : stored) {
    largest = std::max(largest.value_or(0), allowed_error(error));
  }
  return largest;
}

Finding judge_error(const RunView& view, const record::Record& record,
                    const accuracy::LimitErrors& error) {
  const auto limit = allowed_error_on(view.baselines.errors(record.configuration), record.device);
  const bool is_within_limit = limit && error.rmse <= *limit;
  Finding finding = limit ? finding_about(record, Check::accuracy,
                                          is_within_limit ? Verdict::pass : Verdict::regression,
                                          {.cause = Cause::error, .against = Against::baseline})
                          : finding_about(record, Check::accuracy, Verdict::cannot_judge,
                                          {.cause = Cause::not_stored}, view.accept_advice());
  set_number(finding, "rmse", error.rmse);
  set_number(finding, "max_error", error.largest);
  set_number(finding, "error_99", error.error_99);
  set_number(finding, "lattice", error.lattice);
  set_number(finding, "arithmetic", error.arithmetic);
  if (limit) set_number(finding, "bound", *limit);
  return finding;
}

// Fits the order of convergence to the accepted errors of a family (configurations that differ only
// in the step size). The order is fitted again each time, because only the errors are stored.
std::optional<accuracy::Order> stored_order(const RunView& view,
                                            const accuracy::AccuracyScene& scene,
                                            const accuracy::AccuracyFamily& family) {
  std::vector<accuracy::StepError> points;
  for (const std::size_t i : family.members) {
    const accuracy::AccuracyCase& each = scene.cases[i];
    const auto errors = view.baselines.errors(each.configuration);
    const auto own = errors.find(scene.device);
    const auto step = accuracy::step_of(each);
    if (own == errors.end() || !step) continue;
    points.push_back({*step, own->second.rmse, own->second.arithmetic});
  }
  return accuracy::fit_order(points);
}

// Reports a regression if the order of convergence is below the accepted order by more than the
// half widths of both confidence intervals together. If no order can be fitted any longer, although
// the step sizes are the same, errors that do not depend on the step size have grown. This is
// reported as `cannot_judge`.
Finding judge_order(const RunView& view, const record::Device& device,
                    const std::optional<accuracy::Order>& now, const accuracy::Order& stored) {
  Observation observation{.cause = now ? Cause::order : Cause::no_order,
                          .against = Against::baseline};
  set_number(observation, "stored_order", stored.order);
  set_number(observation, "stored_half_width", stored.half_width);
  if (!now) return finding_about(view, device, Check::accuracy, Verdict::cannot_judge, observation);
  set_number(observation, "order", now->order);
  set_number(observation, "half_width", now->half_width);
  const bool is_lower = now->order < stored.order - stored.half_width - now->half_width;
  return finding_about(view, device, Check::accuracy,
                       is_lower ? Verdict::regression : Verdict::pass, std::move(observation));
}

void judge_orders(const RunView& view, const accuracy::AccuracyScene& scene,
                  AccuracyFindings& result) {
  const record::Device& device = view.devices.at(scene.device);
  for (const accuracy::AccuracyFamily& family : scene.families) {
    const auto stored = stored_order(view, scene, family);
    if (!stored) continue;
    Finding finding = judge_order(view, device, family.order, *stored);
    finding.configuration = scene.cases[family.members.back()].configuration;
    result.findings.push_back(std::move(finding));
  }
}

// Collects the scenes, one for each device and limit image, in the order in which they are added.
class Scenes {
 public:
  // A configuration with the level `auto` counts as the same case as the configuration with the
  // level to which `auto` resolves on the device.
  void add(const record::Record& record, const accuracy::LimitImage& limit,
           accuracy::AccuracyCase each) {
    const auto [known, is_new] = index_.try_emplace({record.device, limit.key}, scenes_.size());
    if (is_new) scenes_.push_back(accuracy::accuracy_scene(record, limit));
    accuracy::keep_common_levels(scenes_[known->second], record);
    std::vector<accuracy::AccuracyCase>& cases = scenes_[known->second].cases;
    if (std::ranges::find(cases, each.factors, &accuracy::AccuracyCase::factors) != cases.end())
      return;
    cases.push_back(std::move(each));
  }
  std::vector<accuracy::AccuracyScene> finish() && {
    for (accuracy::AccuracyScene& scene : scenes_) accuracy::evaluate(scene);
    return std::move(scenes_);
  }

 private:
  std::map<std::pair<std::string, std::string>, std::size_t> index_;
  std::vector<accuracy::AccuracyScene> scenes_;
};

// Checks the records one by one. A record that cannot be judged gets a finding, and the check
// continues with the next record.
class AccuracyCheck {
 public:
  AccuracyCheck(const RunView& view, AccuracyFindings& out) : view_(view), out_(out) {
    for (const record::Record* each : view.measured) {
      if (!each->time_ns().empty() && each->clock() == "wall")
        wall_clock_devices_.insert(each->device);
    }
  }

  void check_record(const record::Record& record) {
    try {
      measure_error(record);
    } catch (const core::Error& error) {
      add(record, Verdict::cannot_judge, {.cause = Cause::unknown_error, .detail = error.what()});
    }
  }

  void finish() {
    out_.scenes = std::move(scenes_).finish();
    for (const accuracy::AccuracyScene& scene : out_.scenes) judge_orders(view_, scene, out_);
  }

 private:
  void add(const record::Record& record, Verdict verdict, Observation observation,
           AdviceWithCommand advice = {}) {
    out_.findings.push_back(
        finding_about(record, Check::accuracy, verdict, std::move(observation), std::move(advice)));
  }

  void measure_error(const record::Record& record) {
    const accuracy::LimitImage* limit = view_.request.limit(record);
    if (limit == nullptr) {
      // If no error was accepted for the configuration, its scene had no limit image before either,
      // so it needs no finding.
      if (view_.baselines.errors(record.configuration).empty()) return;
      add(record, Verdict::cannot_judge, {.cause = Cause::no_limit_any_more},
          view_.accept_advice());
      return;
    }
    if (record.image.empty()) {
      add(record, Verdict::cannot_judge, {.cause = Cause::no_image}, {Advice::run_again});
      return;
    }
    const auto error = accuracy::limit_errors(view_.store.decoded_image(record.image),
                                              view_.request.truth(record).truth, limit->image);
    if (!error) {
      add(record, Verdict::regression, {.cause = Cause::not_comparable});
      return;
    }
    const std::string_view clock = wall_clock_devices_.contains(record.device) ? "wall" : "device";
    scenes_.add(record, *limit, accuracy::accuracy_case(record, *error, clock));
    if (view_.baselines.present()) out_.findings.push_back(judge_error(view_, record, *error));
  }

  const RunView& view_;
  AccuracyFindings& out_;
  Scenes scenes_;
  // Devices with at least one record that was timed only by the wall clock. For these devices, the
  // wall clock is used for all records, because times from two clocks are never compared.
  std::set<std::string> wall_clock_devices_;
};

}  // namespace

AccuracyFindings check_accuracies(const RunView& view) {
  AccuracyFindings result;
  if (view.request.limit && view.request.truth) {
    AccuracyCheck check(view, result);
    for (const record::Record* record : view.measured) {
      if (record::has_image(*record)) check.check_record(*record);
    }
    check.finish();
  }
  if (result.findings.empty() && result.scenes.empty()) {
    result.findings.push_back(
        finding_about(view, Check::accuracy, Verdict::cannot_judge, {.cause = Cause::no_limit}));
  }
  return result;
}

}  // namespace triptych::judge
