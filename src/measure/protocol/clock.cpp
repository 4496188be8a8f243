#include "measure/protocol/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "measure/protocol/frame_proof.hpp"
#include "measure/protocol/protocol.hpp"

namespace triptych::measure {
namespace {

constexpr int most_frames = 8;
constexpr int least_frames = 3;
// The time budget for all calibration frames. A device that is too slow for this budget draws only
// the minimum number of frames, least_frames.
constexpr double budget_ns = 0.5e9;

// The ratio that is stored for a clock whose time stamps were never written.
constexpr double never_written = -1;

record::ClockTrust without_time(technique::Work kind, std::string verdict) {
  record::ClockTrust trust;
  trust.work = technique::name_of(kind);
  trust.verdict = std::move(verdict);
  return trust;
}

int frames_within_budget(double frame_ns) {
  if (!(frame_ns > 0)) return most_frames;
  return std::clamp(static_cast<int>(std::min(budget_ns / frame_ns, 1e3)), least_frames,
                    most_frames);
}

std::string percent(double ratio) {
  return fmt::format("{:.1f} %", 100 * ratio);
}

// Returns whether a clock with these ratios of device time to wall time can be trusted. If there
// are at least five ratios, one of them may be too low, because the scheduler may wake the thread
// late. No ratio may be too high, because correct device time is never longer than wall time.
bool is_trustworthy(const std::vector<double>& ratios) {
  const auto low = std::ranges::count_if(
      ratios, [](double ratio) { return !(ratio >= ClockLimits::least_ratio); });
  const bool high =
      std::ranges::any_of(ratios, [](double ratio) { return !(ratio <= ClockLimits::most_ratio); });
  const std::ptrdiff_t allowed_outliers = ratios.size() >= 5 ? 1 : 0;
  const bool zero = std::ranges::any_of(ratios, [](double ratio) { return !(ratio > 0); });
  return !high && !zero && low <= allowed_outliers;
}

std::string verdict_of(const record::ClockTrust& trust, double wall_ns, std::size_t frames) {
  const std::string seen = fmt::format(
      "device time is {} of wall time ({} to {}, {} frames of {:.3g} ms)", percent(trust.ratio),
      percent(trust.ratio_low), percent(trust.ratio_high), frames, wall_ns * 1e-6);
  if (trust.trusted) return "trusted: " + seen;
  if (trust.ratio_high <= 0) {
    return fmt::format("not trusted: the device clock measured 0 ns for {} frames of {:.3g} ms",
                       frames, wall_ns * 1e-6);
  }
  const std::string limits =
      fmt::format("it must be {} to {} for the clock to be trusted",
                  percent(ClockLimits::least_ratio), percent(ClockLimits::most_ratio));
  const bool is_short = wall_ns < ClockLimits::least_frame_ns / 4 && trust.ratio < 1;
  return fmt::format("not trusted: {}; {}{}", seen, limits,
                     is_short ? ", but frames this short are inconclusive" : "");
}

// Makes the frames of a work take longer, by using finer steps along the rays or by drawing the
// same particles with more pixels. The kind of work stays the same. Returns false if the frames
// cannot be made any longer.
bool lengthen(Work& work, double factor) {
  if (auto* volume = std::get_if<VolumeWork>(&work.scene)) {
    constexpr double finest_step_voxels = 1e-3;
    if (volume->scene.step_voxels <= finest_step_voxels) return false;
    volume->scene.step_voxels = std::max(volume->scene.step_voxels / factor, finest_step_voxels);
    return true;
  }
  scene::ParticleScene& scene = std::get<ParticleWork>(work.scene).scene;
  constexpr int most_pixels_a_side = 4096;
  const auto grown = [&](int side) {
    return std::min(static_cast<int>(std::ceil(side * std::sqrt(factor))), most_pixels_a_side);
  };
  if (std::max(scene.width, scene.height) >= most_pixels_a_side) return false;
  scene.width = grown(scene.width);
  scene.height = grown(scene.height);
  return true;
}

// Prepares the work so that its frames are long enough for a calibration, if that is possible.
std::unique_ptr<Prepared> prepare_long_enough(Device& device, Work work) {
  constexpr int most_attempts = 4;
  std::unique_ptr<Prepared> prepared = device.prepare(work);
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    // A second frame is drawn because the first frame is a cold start. It is not needed if the
    // first frame is already too short, because later frames do not take longer.
    double frame_ns = prepared->frame(Purpose::timing).wall_ns;
    if (!(frame_ns < ClockLimits::least_frame_ns)) {
      frame_ns = prepared->frame(Purpose::timing).wall_ns;
      if (!(frame_ns < ClockLimits::least_frame_ns)) break;
    }
    // Aims at 1.5 times the required length, because part of the frame's time does not grow with
    // the work.
    const double missing = 1.5 * ClockLimits::least_frame_ns / std::max(frame_ns, 1e3);
    if (!lengthen(work, std::clamp(missing, 2.0, 64.0)) || device.unsupported(work)) break;
    prepared.reset();
    prepared = device.prepare(work);
  }
  return prepared;
}

}  // namespace

// Checks only the first and the last image, because calibration images are large, and reading an
// image back may take longer than drawing it. If a frame in between drew nothing, its ratio of
// device time to wall time would be outside the limits for a trusted clock.
record::ClockTrust calibrate(Prepared& prepared, technique::Work work_kind) {
  FrameProof proof(prepared);
  const int frames = frames_within_budget(proof.draw(Purpose::timing).wall_ns);
  proof.check("the first frame of the clock calibration");
  std::vector<double> ratios;
  std::vector<double> wall_ns;
  for (int i = 0; i < frames; ++i) {
    const bool last = i + 1 == frames;
    const Frame frame = last ? proof.draw(Purpose::timing) : prepared.frame(Purpose::timing);
    if (last) proof.check("the last frame of the clock calibration");
    if (!frame.device_ns)
      return without_time(work_kind, "not trusted: the device reports no frame times");
    if (std::isnan(*frame.device_ns)) {
      record::ClockTrust trust =
          without_time(work_kind, "not trusted: the driver never wrote a timestamp");
      trust.offered = true;
      trust.ratio = trust.ratio_low = trust.ratio_high = never_written;
      return trust;
    }
    if (!(frame.wall_ns > 0) || !std::isfinite(*frame.device_ns)) {
      return without_time(
          work_kind,
          fmt::format("not trusted: the device clock measured {} ns during {} ns of wall time",
                      *frame.device_ns, frame.wall_ns));
    }
    ratios.push_back(*frame.device_ns / frame.wall_ns);
    wall_ns.push_back(frame.wall_ns);
  }
  record::ClockTrust trust;
  trust.work = technique::name_of(work_kind);
  trust.offered = true;
  trust.ratio = record::percentile(ratios, 0.5);
  trust.ratio_low = std::ranges::min(ratios);
  trust.ratio_high = std::ranges::max(ratios);
  trust.trusted = is_trustworthy(ratios);
  trust.verdict = verdict_of(trust, record::percentile(wall_ns, 0.5), ratios.size());
  return trust;
}

record::ClockTrust calibrate_clock(Device& device, Suite& suite, technique::Work kind) {
  try {
    Work work = suite.calibration(kind);
    if (const auto reason = device.unsupported(work)) {
      return without_time(kind, "not calibrated: " + *reason);
    }
    const auto prepared = prepare_long_enough(device, std::move(work));
    return calibrate(*prepared, kind);
  } catch (const core::DeviceLost&) {
    throw;
  } catch (const core::Error& error) {
    // The error is not fatal, because the wall clock can still be used. If it shows another problem
    // of the device, drawing the configurations will reveal that problem.
    return without_time(kind, fmt::format("not calibrated: {}", error.what()));
  }
}

// Distinguishes three kinds of untrusted clocks by the ratio of device time to wall time:
// - If the ticks have a wrong length, the ratio exceeds 1 or is constant within 5 %.
// - If the clock leaves out launches and waits, the ratio varies by more than 5 % from frame to
//   frame.
// - If the clock leaves out the work itself, the ratio is less than 2 %. For example, it is 0.03 %
//   with lavapipe's time stamps around dispatches.
//
// Only the first kind is a fault.
std::optional<record::DeviceFault> clock_fault(const record::ClockTrust& trust) {
  using enum record::DeviceFaultKind;
  constexpr double steady = 1.05;
  constexpr double least_share = 0.02;
  if (trust.trusted || !trust.offered) return std::nullopt;
  record::DeviceFault fault{
      .kind = clock_rate_wrong, .subject = trust.work, .detail = trust.verdict};
  if (trust.ratio == never_written) {
    fault.kind = clock_not_written;
    return fault;
  }
  if (trust.ratio_high == 0) {
    fault.kind = clock_reads_zero;
    return fault;
  }
  const bool too_long = trust.ratio_low > ClockLimits::most_ratio;
  const bool constant = trust.ratio_low > least_share &&
                        trust.ratio_high < ClockLimits::least_ratio &&
                        trust.ratio_high < steady * trust.ratio_low;
  if (!too_long && !constant) return std::nullopt;
  return fault;
}

bool plausible(const std::vector<double>& device_ns, const std::vector<double>& wall_ns) {
  if (device_ns.empty() || device_ns.size() != wall_ns.size()) return false;
  // A timer with a resolution of 1 µs may be wrong by one tick at either end of a frame, so the
  // difference of its two readings may be wrong by 2 µs.
  constexpr double tick_ns = 2e3;
  std::size_t low = 0;
  for (std::size_t i = 0; i < device_ns.size(); ++i) {
    if (!(device_ns[i] > 0)) return false;
    if (!(device_ns[i] <= wall_ns[i] * ClockLimits::most_ratio + tick_ns)) return false;
    if (device_ns[i] < wall_ns[i] * ClockLimits::least_ratio_in_use - ClockLimits::launch_ns) ++low;
  }
  return 4 * low <= device_ns.size();
}

}  // namespace triptych::measure
