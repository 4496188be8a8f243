#pragma once
// Determines whether a device's clock is trustworthy. See calibrate() in
// measure/protocol/protocol.hpp.

#include <optional>

#include "measure/contract/backend.hpp"
#include "measure/contract/suite.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// The limits for a trustworthy clock. All ratios are the device time of a frame divided by its wall
// time.
struct ClockLimits {
  // Besides the work, wall time includes the submission and the delay until the waiting thread
  // wakes up. A busy scheduler delays two wake-ups by about a millisecond in total, and a launch
  // takes less than that. A calibration frame lasts at least least_frame_ns, which is 20 ms, so a
  // tenth of it covers both. If a clock leaves out the work itself, the ratio is far smaller (0 to
  // 0.25 with every such driver that was observed).
  static constexpr double least_ratio = 0.9;
  // The wall time includes the work, so the exact device time is never longer. However, the rates
  // of the two clocks differ by up to 500 ppm (the kernel's slew limit), and a measured time may be
  // wrong by one tick. Even with ticks of 0.2 ms, both errors together are less than 2 % of 20 ms.
  static constexpr double most_ratio = 1.02;
  static constexpr double least_frame_ns = 20e6;
  // In normal use, the requirement is weaker, because the frames of a configuration may be short
  // and the machine may be busy. For three of four frames, the device time must be at least half of
  // the wall time minus launch_ns. This still detects a clock that is correct for one kernel, but
  // reports 0.01 ms for a 28 ms frame of another kernel (lavapipe).
  static constexpr double least_ratio_in_use = 0.5;
  static constexpr double launch_ns = 0.2e6;
};

// Prepares the suite's calibration work. On a fast device, enlarges the work until a frame lasts
// ClockLimits::least_frame_ns. Then calibrates the clock. If the device does not support this kind
// of work, the verdict states the reason. Throws DeviceLost.
[[nodiscard]] record::ClockTrust calibrate_clock(Device& device, Suite& suite,
                                                 technique::Work kind);

// Returns the fault of an untrusted clock: it was never written, it reads 0, or its ticks do not
// have the length that the device reports. Returns nullopt for a trusted clock, and for a clock
// that merely leaves out launches, waits or work.
[[nodiscard]] std::optional<record::DeviceFault> clock_fault(const record::ClockTrust& trust);

// Returns whether the device times of a configuration's frames are plausible: present for each
// frame, greater than 0, not longer than the wall time, and not much shorter than the wall time.
// This check is needed in addition to the calibration, which is valid only for the calibration
// work.
[[nodiscard]] bool plausible(const std::vector<double>& device_ns,
                             const std::vector<double>& wall_ns);

}  // namespace triptych::measure
