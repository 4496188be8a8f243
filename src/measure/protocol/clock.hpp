#pragma once
// Decides whether a device's clock is trustworthy. See calibrate() in
// measure/protocol/protocol.hpp.

#include <optional>

#include "measure/contract/backend.hpp"
#include "measure/contract/suite.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// The limits for a trustworthy clock: device time divided by wall time of one frame.
struct ClockLimits {
  // Wall time also contains the submission and waking up the waiting thread. A calibration frame
  // lasts at least least_frame_ns. Two passes through a busy scheduler cost about a millisecond,
  // and a launch less, so a tenth of 20 ms covers both. A clock that leaves out the work itself
  // shows far less (0 to 0.25 on every such driver seen).
  static constexpr double least_ratio = 0.9;
  // The work lies within the wall time, so the exact device time is never longer. The rates of two
  // clocks differ by up to 500 ppm (the kernel's slew limit), and each reading by a tick. With
  // timers as coarse as 0.2 ms this stays below 2 % of 20 ms.
  static constexpr double most_ratio = 1.02;
  static constexpr double least_frame_ns = 20e6;
  // The frames of a configuration may be short, and the machine may be busy, so the requirement is
  // weaker: for three of four frames, device time must be at least half of the wall time minus
  // launch_ns. That still finds a clock that is right for one kernel and shows 0.01 ms of a frame
  // of 28 ms for another one (lavapipe).
  static constexpr double least_ratio_in_use = 0.5;
  static constexpr double launch_ns = 0.2e6;
};

// Prepares the suite's calibration work, makes it longer on a fast device until a frame lasts
// ClockLimits::least_frame_ns, and calibrates. If a device cannot do this kind of work, the verdict
// states it. Throws DeviceLost.
[[nodiscard]] record::ClockTrust calibrate_clock(Device& device, Suite& suite,
                                                 technique::Work kind);

// The fault of a clock that is not trusted: it was never written, it reads 0, or its ticks do not
// have the length that the device reports. nullopt for a trusted clock, and for a clock that only
// leaves out launches, waits or work.
[[nodiscard]] std::optional<record::DeviceFault> clock_fault(const record::ClockTrust& trust);

// Whether the device times of one configuration's frames are possible at all: present for each
// frame, above 0, not longer than the frame's wall time allows, and not missing most of it. Needed
// in addition to the calibration, which is valid for one work only.
[[nodiscard]] bool plausible(const std::vector<double>& device_ns,
                             const std::vector<double>& wall_ns);

}  // namespace triptych::measure
