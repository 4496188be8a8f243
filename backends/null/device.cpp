#include "backends/null/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <thread>
#include <utility>
#include <variant>

#include "backends/null/synthetic.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/image_io.hpp"
#include "core/random.hpp"
#include "record/device_id.hpp"
#include "technique/catalogue.hpp"

namespace triptych::null_backend {
namespace {

// The largest width and height that a scripted device supports. The limit keeps the clock
// calibration short, which draws ever larger images until a frame takes long enough. The time of a
// scripted frame need not grow with the image, so the calibration may go on up to this size, and
// reading an even larger image would take seconds.
constexpr int largest_image = 2048;

// Returns a nearly normally distributed number with mean 0 and variance 1, computed from twelve
// uniform numbers. It uses no function whose result may differ between platforms.
double normal(core::Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.uniform();
  return sum;
}

double factor_of(const Script& script, const std::string& subject) {
  for (const auto& [glob, factor] : script.factors) {
    if (matches(glob, subject)) return factor;
  }
  return 1;
}

// Allocates memory for the first glob that matches, and keeps it until the process ends.
void keep_memory(const std::vector<std::pair<std::string, double>>& sizes,
                 const std::string& subject) {
  static std::vector<std::vector<char>> kept;
  for (const auto& [glob, bytes] : sizes) {
    if (!matches(glob, subject)) continue;
    kept.emplace_back(static_cast<std::size_t>(bytes), '\1');
    return;
  }
}

double frame_ns(const Script& script, const measure::Work& work, double device_factor,
                const std::string& subject, int frame) {
  double ns = device_factor * (script.base_ns + script.ns_per_sample * samples_of(work));
  ns *= (1 + extra_share(work)) * factor_of(script, subject);
  if (frame == 0) ns *= script.warm_up_factor;
  core::Random random(script.seed ^ number_of(fmt::format("{},frame={}", subject, frame)));
  ns *= std::max(0.01, 1 + script.noise * normal(random));
  if (random.uniform() < script.outlier_share) ns *= script.outlier_factor;
  return ns;
}

core::Image draw_image(const Script& script, const measure::Work& work,
                       const std::string& subject) {
  if (script.draw) return script.draw(work);
  for (const auto& [glob, file] : script.images) {
    if (matches(glob, subject)) return core::read_exr(file);
  }
  return pattern(work);
}

class NullPrepared final : public measure::Prepared {
 public:
  NullPrepared(std::shared_ptr<const Script> script, measure::Work work, std::string subject,
               double device_factor)
      : script_(std::move(script)),
        work_(std::move(work)),
        subject_(std::move(subject)),
        device_factor_(device_factor) {}

  ~NullPrepared() override { log_call(*script_, "destroy"); }

  void poison() override {
    log_call(*script_, "poison");
    overwritten_ = true;
    drawn_ = false;
  }

  measure::Frame frame(measure::Purpose purpose) override {
    const char* const name = purpose == measure::Purpose::timing       ? "timing"
                             : purpose == measure::Purpose::statistics ? "statistics"
                                                                       : "counters";
    log_call(*script_, fmt::format("frame {}", name));
    const int number = frames_++;
    trigger_failure(*script_, Place::frame, subject_, number);
    drawn_ = true;
    measure::Frame frame;
    frame.wall_ns = frame_ns(*script_, work_, device_factor_, subject_, number);
    if (script_->sleep) {
      std::this_thread::sleep_for(std::chrono::duration<double, std::nano>(frame.wall_ns));
    }
    if (purpose == measure::Purpose::timing) {
      if (script_->device_over_wall) frame.device_ns = frame.wall_ns * *script_->device_over_wall;
    } else if (script_->counts) {
      frame.counts =
          purpose == measure::Purpose::counters ? counters_of(work_) : statistics_of(work_);
      const auto samples = frame.counts.find("samples");
      if (samples != frame.counts.end()) samples->second += script_->extra_samples;
    }
    return frame;
  }

  core::Image image() override {
    if (overwritten_ && !drawn_) return filled(std::numeric_limits<float>::quiet_NaN());
    log_call(*script_, "image");
    if (frames_ == 0) throw core::Error("the image was requested before a frame was drawn");
    trigger_failure(*script_, Place::image, subject_);
    if (!image_) image_ = drawn_image();
    const bool stale = failure_ == FailureKind::stale_image && frames_ > 1 && overwritten_;
    return stale ? filled(std::numeric_limits<float>::quiet_NaN()) : *image_;
  }

  std::string kernel_hash() const override {
    return core::content_hash("null " + script_->driver_version + " " + code_key(work_));
  }

 private:
  [[nodiscard]] core::Image filled(float value) const {
    core::Image image = draw_image(*script_, work_, subject_);
    std::ranges::fill(image.rgba, value);
    return image;
  }

  // Called once for each prepared work. A failure that the script limits to one occurrence (`once`)
  // therefore still affects all frames until the work is prepared again.
  [[nodiscard]] core::Image drawn_image() {
    core::Image image = draw_image(*script_, work_, subject_);
    failure_ = image_failure(*script_, subject_);
    if (failure_ == FailureKind::nan_image) {
      std::ranges::fill(image.rgba, std::numeric_limits<float>::quiet_NaN());
    } else if (failure_ == FailureKind::wrong_image) {
      for (float& channel : image.rgba) channel += 0.25F;
    }
    return image;
  }

  std::shared_ptr<const Script> script_;
  measure::Work work_;
  std::string subject_;
  double device_factor_;
  int frames_ = 0;
  bool overwritten_ = false;  // whether poison() was called
  bool drawn_ = false;        // whether a frame was drawn since poison() was called
  std::optional<core::Image> image_;
  std::optional<FailureKind> failure_;
};

class NullDevice final : public measure::Device {
 public:
  NullDevice(std::shared_ptr<const Script> script, std::size_t index)
      : script_(std::move(script)),
        info_(devices_of(*script_).at(index)),
        factor_(script_->devices.at(index)) {}

  const record::Device& info() const override { return info_; }

  std::optional<std::string> unsupported(const measure::Work& work) const override {
    try {
      static_cast<void>(technique::technique(work.technique));
      trigger_failure(*script_, Place::supports, describe(work));
    } catch (const core::NotSupported& reason) {
      return reason.what();
    } catch (const core::InputError& unknown) {
      return unknown.what();
    }
    const int side = std::visit(
        [](const auto& each) { return std::max(each.scene.width, each.scene.height); }, work.scene);
    if (side > largest_image) {
      return fmt::format(
          "the image is {} pixels wide or high, but the null backend supports at most {}", side,
          largest_image);
    }
    return std::nullopt;
  }

  measure::VolumePath default_path(const measure::VolumeKind& volume) const override {
    // As with real backends, the default sampler depends on whether a sample needs only one
    // filtered value, or also the voxels around it.
    return {.voxel = volume.native,
            .sampler =
                volume.filter_suffices ? technique::Sampler::manual : technique::Sampler::packed};
  }

  double filter_weight_error(const measure::VolumePath& path) const override {
    return path.sampler == technique::Sampler::hardware ? script_->filter_weight_error : 0;
  }

  std::unique_ptr<measure::Prepared> prepare(const measure::Work& work) override {
    log_call(*script_, "prepare " + work.technique);
    if (const auto reason = unsupported(work)) throw core::NotSupported(*reason);
    std::string subject = describe(work);
    const std::size_t earlier = prepares_[subject]++;
    keep_memory(script_->leaks, subject);
    if (earlier == 0) keep_memory(script_->caches, subject);
    trigger_failure(*script_, Place::prepare, subject, static_cast<int>(earlier));
    record_prepared(subject);
    const auto& factors = script_->prepare_factors;
    const double factor = factor_ * (earlier < factors.size() ? factors[earlier] : 1.0);
    return std::make_unique<NullPrepared>(script_, work, std::move(subject), factor);
  }

 private:
  std::shared_ptr<const Script> script_;
  record::Device info_;
  double factor_;
  std::map<std::string, std::size_t> prepares_;  // number of times that each work was prepared
};

}  // namespace

std::vector<record::Device> devices_of(const Script& script) {
  std::vector<record::Device> devices;
  for (std::size_t i = 0; i < script.devices.size(); ++i) {
    record::Device& device = devices.emplace_back();
    device.id = record::numbered_id("null:scripted", static_cast<int>(i) + 1);
    device.api = "null";
    device.name = "Scripted device";
    device.vendor = "Triptych";
    device.driver = "scripted";
    device.driver_version = script.driver_version;
    device.api_version = "1";
  }
  return devices;
}

std::unique_ptr<measure::Device> make_device(std::shared_ptr<const Script> script,
                                             std::size_t index) {
  return std::make_unique<NullDevice>(std::move(script), index);
}

}  // namespace triptych::null_backend
