#pragma once
// Measures one configuration. This code does not depend on an API; it is tested with the scripted
// clock of the null backend.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "measure/contract/backend.hpp"
#include "measure/counting/instruction_counter.hpp"
#include "measure/system/energy_meters.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// The protocol of the paper (Bruder et al.): warm-up frames, which also determine how many frames
// fill the wall-clock loop; timed frames; one frame for pipeline statistics; one for Triptych's
// counters; and the wall-clock loop.
struct Protocol {
  int warm_up_frames = 4;  // minimum number
  int timed_frames = 8;
  double least_loop_ns = 100e6;  // minimum time of the wall-clock loop
  int most_loop_frames = 1000;
  bool statistics = true;
  bool counters = true;
  // If false, only one frame each is drawn for the image, the statistics and Triptych's counters.
  // Nothing is warmed up, and there are no times and no benchmark.
  bool timed = true;
  // If true, the instructions of the third frame are counted (counting/emulator.hpp), and no times
  // are measured. Counters and the image are recorded only if they are requested.
  bool counted = false;
  bool picture = true;  // whether the image of a counted frame is recorded
  // If true, the compiler's report about the device code is recorded, and no frame is drawn.
  bool compiled = false;
  // If false, a configuration that does exactly the same work as an earlier one
  // (measure/contract/equivalents.hpp) copies the results of the earlier configuration.
  bool measure_every = false;
  // True if a frame with another camera is drawn before the first frame. Then the first frames may
  // differ where surfaces are equally far away. The worker sets this field itself; it is never
  // sent.
  bool camera_jumps = false;

  [[nodiscard]] bool has_loop() const noexcept { return timed && least_loop_ns > 0; }
};

// For times that are displayed but not judged. Timing begins with the third frame, as in
// count_instructions(), and there is no loop. Five frames are sufficient to decide whether device
// times are plausible (measure/protocol/clock.hpp).
inline constexpr Protocol brief_protocol{
    .warm_up_frames = 2, .timed_frames = 5, .least_loop_ns = 0, .most_loop_frames = 1};

struct Measurement {
  record::Record record;  // everything that does not depend on the plan: times, counts, hashes
  core::Image image;      // the image of the last timed frame
};

// Measures one prepared technique by the protocol; Google Benchmark drives the timed loop.
// `work_kind` selects the clock in `clocks`, and `name` becomes the name of the benchmark. If there
// is a loop, a second loop measures energy with `meters`.
[[nodiscard]] Measurement measure(Prepared& prepared, const Protocol& protocol,
                                  technique::Work work_kind,
                                  const std::vector<record::ClockTrust>& clocks,
                                  const std::string& name, const EnergyMeters* meters = nullptr);

// Counts the instructions of the third frame, because drivers compile code and initialize during
// the first two frames. A count is compared only with counts of the third frame.
[[nodiscard]] Measurement count_instructions(Prepared& prepared, const Protocol& protocol,
                                             const InstructionCounter& counter);

// Compares the device time of a calibration work with its wall time, frame by frame. The clock is
// trusted if the ratio of every frame is within ClockLimits (measure/protocol/clock.hpp). If there
// are five or more frames, one may have been late because of the scheduler. Device time may leave
// out launching and waking up. A clock that reads 0, less than most of the wall time, or more than
// the wall time, is not trusted.
[[nodiscard]] record::ClockTrust calibrate(Prepared& prepared, technique::Work work_kind);

// Returns the content hash of an image's exact bits and its size, which is the key for
// Store::image().
[[nodiscard]] std::string image_hash(const core::Image& image);

}  // namespace triptych::measure
