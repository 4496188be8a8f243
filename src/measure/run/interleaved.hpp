#pragma once
// Measures two workers that take turns on one machine (interleaved A/B), so that a disturbance
// slows down both workers. Each side, A or B, has one worker. A batch is a number of frames that
// one worker draws in a row. A block consists of four batches, two of each side. Their order is
// chosen at random, either ABBA or BAAB, so that a drift that is linear over the four batches
// cancels out of the difference. If batches are short, a block repeats the four batches several
// times and uses the minimum time of each batch. Disturbances on the CPU last for tens of
// milliseconds and can only make a batch slower, so the minimum removes them.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/random.hpp"
#include "measure/contract/suite.hpp"
#include "measure/system/interrupt.hpp"
#include "measure/worker/wire.hpp"
#include "measure/worker/worker_setup.hpp"

namespace triptych::measure {

enum class Side : std::uint8_t { a, b };
[[nodiscard]] std::string_view name_of(Side side);

// Thrown if a side could not measure a configuration: it does not support the configuration, an
// error occurred, or its worker died, exceeded the time limit or lost the device. The work of both
// sides on this configuration has ended. For the next configuration, new workers are started if
// necessary.
class SideEnded : public record::NotMeasured {
 public:
  SideEnded(Side side, record::Outcome outcome, record::Reason reason)
      : NotMeasured(outcome, std::move(reason)), side_(side) {}
  [[nodiscard]] Side side() const noexcept { return side_; }

 private:
  Side side_;
};

// The mean time of a frame in each of the two batches of a side. If a block repeats its batches,
// each value is the minimum over the repetitions.
struct SideTimes {
  std::array<double, 2> wall_ns{};
  std::optional<std::array<double, 2>> device_ns;  // set if the device timed all frames
};

struct Block {
  bool b_first = false;  // whether the order of the batches is BAAB instead of ABBA
  SideTimes a;
  SideTimes b;
};

enum class SideClock : std::uint8_t { wall, device };

// Returns d = ½(ln b₁ + ln b₂ − ln a₁ − ln a₂) for each block, where a₁, a₂, b₁ and b₂ are the
// times of the batches of both sides. SideClock::device requires that the blocks have device times.
// A time of 0 counts as one nanosecond.
[[nodiscard]] std::vector<double> differences(std::span<const Block> blocks, SideClock clock);

// Returns whether the device times of both sides are plausible (see plausible() in
// measure/protocol/clock.hpp).
[[nodiscard]] bool device_times_plausible(std::span<const Block> blocks);

struct InterleavedOptions {
  std::string suite;
  std::vector<std::string> kinds;  // kinds of work in the plan, for which the clocks are calibrated
  std::chrono::seconds limit{60};  // time limit for one answer, after which the worker is killed
  std::chrono::seconds start_limit{60};  // time limit for opening a device and calibrating
  // If a frame is shorter than this time, several frames (at most 1000) are drawn in each batch, so
  // that the batch lasts this long. Batches of both sides have the same number of frames.
  double least_batch_ns = 1e6;
  // A block repeats its four batches until it lasts this long, but at most ten times.
  double least_block_ns = 40e6;
  std::uint64_t seed = 1;  // seed for the random order of the batches in each block
};

class Interleaved {
 public:
  // Opens both sides. Throws InputError for environment variables that must not be set while
  // measuring, and record::NotMeasured with the reason if a side cannot be opened.
  Interleaved(InterleavedOptions options, const SideOptions& a, const SideOptions& b);
  ~Interleaved();
  Interleaved(const Interleaved&) = delete;
  Interleaved& operator=(const Interleaved&) = delete;

  // Returns the device and its clocks, as reported by the first worker of the side.
  [[nodiscard]] const Hello& hello(Side side) const;

  // All functions below throw SideEnded. They throw Interrupted if a signal asks the program to
  // stop.

  // Makes both sides prepare the configuration, keep it prepared, and draw a few frames to warm up.
  // The times of these frames on `clock` determine the number of frames in a batch, and how often a
  // block repeats its batches. The previous configuration is released.
  void hold(const Configuration& configuration,
            const std::array<std::vector<std::string>, 2>& faults, SideClock clock,
            const OnLoading& on_loading = {});
  [[nodiscard]] int frames_per_batch() const noexcept { return frames_per_batch_; }
  // Returns how often a block repeats its four batches.
  [[nodiscard]] int repetitions_per_block() const noexcept { return repetitions_per_block_; }
  // Measures one block of the prepared configuration.
  [[nodiscard]] Block block();
  void release();

  // Replaces both workers with new workers, which have no prepared configuration.
  void restart();

 private:
  class Slot;
  // Measures the four batches once more, and stores each new time in `block` if it is smaller.
  void measure_batches(Block& block);
  [[nodiscard]] Slot& slot(Side side) const { return *slots_.at(side == Side::a ? 0 : 1); }

  InterleavedOptions options_;
  core::Random random_;
  InterruptGuard interrupts_;
  std::array<std::unique_ptr<Slot>, 2> slots_;
  int frames_per_batch_ = 1;
  int repetitions_per_block_ = 1;
};

}  // namespace triptych::measure
