#pragma once
// Whether a device's clock is to be believed. See calibrate() in measure/protocol/protocol.hpp.

#include "measure/contract/backend.hpp"
#include "measure/contract/suite.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// What a believable clock may say. Device time over wall time of one frame:
struct ClockLimits {
  // Wall time also holds the submission and the waking of the waiting thread. A calibration frame
  // lasts at least least_frame_ns; two passes through a busy scheduler cost about a millisecond, a
  // launch less: a tenth of 20 ms covers both, while a clock that leaves out the work itself reads
  // far less (0 to 0.25 on every such driver seen).
  static constexpr double least_ratio = 0.9;
  // The work lies within the wall time: a true device time is never longer. Two clocks differ in
  // rate by up to 500 ppm (the kernel's slew limit) and in the reading by a tick each; timers as
  // coarse as 0.2 ms on 20 ms stay below 2 %.
  static constexpr double most_ratio = 1.02;
  static constexpr double least_frame_ns = 20e6;
  // A configuration's own frames may be short and the machine busy, so less is asked of them:
  // beyond launch_ns for the launch, half of the wall time, by three frames of four. That still
  // finds the clock that is right about one kernel and reads 0.01 of 28 ms around another
  // (lavapipe).
  static constexpr double least_ratio_in_use = 0.5;
  static constexpr double launch_ns = 0.2e6;
};

// Prepares the suite's calibration work, lengthens it on a fast device until a frame lasts
// ClockLimits::least_frame_ns, and calibrates. A device that cannot do this kind of work gets a
// verdict that says so. Throws DeviceLost.
[[nodiscard]] record::ClockTrust calibrate_clock(Device& device, Suite& suite,
                                                 technique::Work kind);

// Whether the device times of one configuration's frames can be true at all: present for each,
// above 0, none longer than the frame's wall time allows, and not leaving out most of it. What
// calibration said of the clock holds for one work only.
[[nodiscard]] bool plausible(const std::vector<double>& device_ns,
                             const std::vector<double>& wall_ns);

}  // namespace triptych::measure
