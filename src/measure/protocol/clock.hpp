#pragma once
// Determines whether a device's clock is trustworthy. See calibrate() in
// measure/protocol/protocol.hpp.

#include <optional>

#include "measure/contract/backend.hpp"
#include "measure/contract/suite.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// The limits for a trustworthy clock. Ratios are the device time of a frame divided by its wall
// time.
struct ClockLimits {
  // Wall time also contains the submission and the time until the waiting thread wakes up. A
  // calibration frame lasts at least least_frame_ns. Waiting twice for a busy scheduler takes about
  // a millisecond, and a launch takes less, so a tenth of 20 ms covers both. If a clock leaves out
  // the work itself, the ratio is far smaller (0 to 0.25 with every such driver that was observed).
  static constexpr double least_ratio = 0.9;
  // The wall time includes the work, so the exact device time is never longer. However, the rates
  // of two clocks differ by up to 500 ppm (the kernel's slew limit), and a measured time may be
  // wrong by a tick. Even with ticks of 0.2 ms, the sum is less than 2 % of 20 ms.
  static constexpr double most_ratio = 1.02;
  static constexpr double least_frame_ns = 20e6;
  // The frames of a configuration may be short, and the machine may be busy, so the requirement is
  // weaker: for three of four frames, device time must be at least half of the wall time minus
  // launch_ns. This still detects a clock that is correct for one kernel, but reports 0.01 ms for a
  // 28 ms frame of another kernel (lavapipe).
  static constexpr double least_ratio_in_use = 0.5;
  static constexpr double launch_ns = 0.2e6;
};

// Prepares the suite's calibration work, makes it longer on a fast device until a frame lasts
// ClockLimits::least_frame_ns, and calibrates. If the device does not support this kind of work,
// the verdict states the reason. Throws DeviceLost.
[[nodiscard]] record::ClockTrust calibrate_clock(Device& device, Suite& suite,
                                                 technique::Work kind);

// Returns the fault of a clock that is not trusted: it was never written, it reads 0, or its ticks
// do not have the length that the device reports. Returns nullopt for a trusted clock, and for a
// clock that only leaves out launches, waits or work.
[[nodiscard]] std::optional<record::DeviceFault> clock_fault(const record::ClockTrust& trust);

// Whether the device times of a configuration's frames are plausible: present for each frame, above
// 0, not longer than the wall time, and not much shorter than it. This check is needed in addition
// to the calibration, which is valid only for the calibration work.
[[nodiscard]] bool plausible(const std::vector<double>& device_ns,
                             const std::vector<double>& wall_ns);

}  // namespace triptych::measure
