#pragma once
// Measures one configuration. This code does not depend on an API. It is tested with the null
// backend, whose clock returns predefined times.

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

// The protocol of the paper (Bruder et al.). It consists of warm-up frames, which also determine
// how many frames fill the wall-clock loop; timed frames; one frame for pipeline statistics; one
// frame for Triptych's counters; and the wall-clock loop.
struct Protocol {
  int warm_up_frames = 4;  // minimum number of warm-up frames
  int timed_frames = 8;
  double least_loop_ns = 100e6;  // minimum time of the wall-clock loop
  int most_loop_frames = 1000;
  bool statistics = true;
  bool counters = true;
  // If false, one frame is drawn for the image, one for the statistics, one for Triptych's
  // counters, and one to check that repeated commands are executed again. There is no warm-up, no
  // timing and no benchmark.
  bool timed = true;
  // If true, the instructions of the third frame are counted (counting/emulator.hpp), and no times
  // are measured. Triptych's counters and the image are recorded only if they are requested.
  bool counted = false;
  bool keep_image = true;  // whether the image of a counted frame is recorded
  // If true, a configuration whose instructions are to be counted is first drawn without the
  // emulator, only so that the driver stores the compiled code in its cache
  // (run/ahead_compiler.hpp). The result is discarded.
  bool ahead = false;
  // If true, the compiler's report about the device code is recorded, and no frame is drawn.
  bool compiled = false;
  // If false, a configuration that does exactly the same work as an earlier configuration copies
  // the results of the earlier configuration (measure/contract/equivalents.hpp).
  bool measure_every = false;
  // Whether a frame with another camera is drawn before the first frame. The first frames then draw
  // some particles in another order than later frames, so a pixel in which several surfaces are
  // equally far away may differ between them. The worker sets this field itself. It is not part of
  // any message.
  bool camera_jumps = false;

  [[nodiscard]] bool has_loop() const noexcept { return timed && least_loop_ns > 0; }
};

// The protocol for times that are displayed but not judged. Timing begins with the third frame, as
// in count_instructions(), and there is no wall-clock loop. Five frames are sufficient to decide
// whether device times are plausible (measure/protocol/clock.hpp).
inline constexpr Protocol brief_protocol{
    .warm_up_frames = 2, .timed_frames = 5, .least_loop_ns = 0, .most_loop_frames = 1};

struct Measurement {
  record::Record record;  // everything that does not depend on the plan: times, counts, hashes
  // The image of the last timed frame. If no times are measured, the image of the first frame, or
  // of the frame whose instructions were counted.
  core::Image image;
};

// Measures one prepared technique by the protocol. Google Benchmark runs the timed frames and the
// wall-clock loop. `work_kind` selects the clock in `clocks`, and `name` becomes the name of the
// benchmark. If the protocol contains the wall-clock loop, the energy is measured with `meters` in
// a second loop.
[[nodiscard]] Measurement measure(Prepared& prepared, const Protocol& protocol,
                                  technique::Work work_kind,
                                  const std::vector<record::ClockTrust>& clocks,
                                  const std::string& name, const EnergyMeters* meters = nullptr);

// Counts the instructions of the third frame. The first two frames are not suitable, because
// drivers compile code and initialize themselves while they are drawn.
[[nodiscard]] Measurement count_instructions(Prepared& prepared, const Protocol& protocol,
                                             const InstructionCounter& counter);

// Compares the device time of a calibration work with its wall time, frame by frame. The clock is
// trusted if the ratio of every frame is within ClockLimits (measure/protocol/clock.hpp). If there
// are five or more frames, the ratio of one frame may be too low, because the scheduler may have
// delayed it. The limits allow the device time to leave out the launch and the wake-up of the
// waiting thread, but not to be longer than the wall time.
[[nodiscard]] record::ClockTrust calibrate(Prepared& prepared, technique::Work work_kind);

// Returns the hash of an image's size and exact bits, which is the key for Store::image().
[[nodiscard]] std::string image_hash(const core::Image& image);

}  // namespace triptych::measure
