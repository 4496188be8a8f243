#pragma once
// How one configuration is measured. Knows no API: it is tested with the null backend's scripted
// clock.

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

// The paper's protocol (Bruder et al.): warm-up frames that also tell how many frames fill the
// least wall time, timed frames, one frame for pipeline statistics, one for our counters, the
// wall-clock loop.
struct Protocol {
  int warm_up_frames = 4;  // at least
  int timed_frames = 8;
  double least_loop_ns = 100e6;  // of the wall-clock loop
  int most_loop_frames = 1000;
  bool statistics = true;
  bool counters = true;
  // Else one frame each for its picture, the statistics and our counters: nothing is warmed up, and
  // no time or benchmark is told.
  bool timed = true;
  // The instructions of the third frame (counting/emulator.hpp) and no time; our counters and its
  // picture where they are asked for.
  bool counted = false;
  bool picture = true;  // kept of a counted frame, too
  // The compiler is asked about the device code, and no frame is drawn.
  bool compiled = false;
  // Else a configuration that does the very work of one before (measure/contract/equivalents.hpp)
  // takes over what that one told.
  bool measure_every = false;
  // The worker's own, never sent to it: the frame before the first is drawn from elsewhere, so that
  // the first frames may differ where surfaces tie.
  bool camera_jumps = false;
  // Likewise: the image is one that is compared with a reference image.
  bool image_is_judged = true;

  [[nodiscard]] bool has_loop() const noexcept { return timed && least_loop_ns > 0; }
};

// Where times are shown and decide nothing: the third frame on, as in count_instructions(), and no
// loop. Five frames still tell whether a device's clock can be believed
// (measure/protocol/clock.hpp).
inline constexpr Protocol brief_protocol{
    .warm_up_frames = 2, .timed_frames = 5, .least_loop_ns = 0, .most_loop_frames = 1};

struct Measurement {
  record::Record record;  // everything that can be known below the plan: times, counts, hashes
  core::Image image;      // of the last timed frame
};

// Drives one prepared technique through the protocol; Google Benchmark drives the timed loop.
// `work_kind` picks the clock in `clocks`. `name` becomes the benchmark's name. Where there is a
// loop, a second one tells energy by `meters`.
[[nodiscard]] Measurement measure(Prepared& prepared, const Protocol& protocol,
                                  technique::Work work_kind,
                                  const std::vector<record::ClockTrust>& clocks,
                                  const std::string& name, const EnergyMeters* meters = nullptr);

// The instructions of one frame, the third: drivers compile late and set up once within the first
// two. The n-th frame is only ever compared with the n-th.
[[nodiscard]] Measurement count_instructions(Prepared& prepared, const Protocol& protocol,
                                             const InstructionCounter& counter);

// Device time of a calibration work against its wall time, frame by frame. Trusted when the ratio
// of every frame lies within ClockLimits (measure/protocol/clock.hpp), one late wake-up among five
// or more frames excused: device time may leave out launch and wake-up, but a clock that reads 0,
// or less than most of the wall time, or more than it, is not believed.
[[nodiscard]] record::ClockTrust calibrate(Prepared& prepared, technique::Work work_kind);

// Content hash of the exact bits of an image, its size included: the key of Store::image().
[[nodiscard]] std::string image_hash(const core::Image& image);

}  // namespace triptych::measure
