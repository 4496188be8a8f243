#pragma once
// Two workers that alternate on one machine, so that whatever slows the machine down slows both.
// Blocks of batches in random order, A B B A or B A A B: a drift that is linear over four batches
// cancels out of their difference. Short batches are taken so several times, and the least of each
// of the four counts: what disturbs one side's processor and not the other's comes and goes within
// tens of milliseconds, and only adds.

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

// One side failed to do its part of one configuration: not supported, an error, its worker dead,
// late or lost. What was asked of both sides is over; the next configuration gets a new worker
// where one is needed.
class SideEnded : public record::NotMeasured {
 public:
  SideEnded(Side side, record::Outcome outcome, record::Reason reason)
      : NotMeasured(outcome, std::move(reason)), side_(side) {}
  [[nodiscard]] Side side() const noexcept { return side_; }

 private:
  Side side_;
};

// Mean time of a frame in each of a side's two batches, the least of those that a block took so.
struct SideTimes {
  std::array<double, 2> wall_ns{};
  std::optional<std::array<double, 2>> device_ns;  // where the device told it of every frame
};

struct Block {
  bool b_first = false;  // B A A B
  SideTimes a;
  SideTimes b;
};

enum class SideClock : std::uint8_t { wall, device };

// d = ½(ln b₁ + ln b₂ − ln a₁ − ln a₂) of each block. Device times must be there for
// SideClock::device; a time of nothing counts as a nanosecond.
[[nodiscard]] std::vector<double> differences(std::span<const Block> blocks, SideClock clock);

// Whether the device times of both sides can be true at all (plausible(),
// measure/protocol/clock.hpp).
[[nodiscard]] bool device_clock_holds(std::span<const Block> blocks);

struct InterleavedOptions {
  std::string suite;
  std::vector<std::string> kinds;        // of work that the plan needs: their clocks are calibrated
  std::chrono::seconds limit{60};        // of one answer; a worker past it is killed
  std::chrono::seconds start_limit{60};  // of opening a device and calibrating its clocks
  // Shorter frames are batched, as many on either side, until a batch lasts this long.
  double least_batch_ns = 1e6;
  // The four batches are taken again until a block lasts this long.
  double least_block_ns = 40e6;
  std::uint64_t seed = 1;  // of the blocks' orders
};

class Interleaved {
 public:
  // Opens both. Throws InputError for an environment that forbids measuring, record::NotMeasured
  // with the reason when a side cannot be opened.
  Interleaved(InterleavedOptions options, const SideOptions& a, const SideOptions& b);
  ~Interleaved();
  Interleaved(const Interleaved&) = delete;
  Interleaved& operator=(const Interleaved&) = delete;

  // Device and clocks, as the first worker of the side told them.
  [[nodiscard]] const Hello& hello(Side side) const;

  // All that follow throw SideEnded, and Interrupted when a signal asks to stop.

  // Both sides prepare the configuration, keep it and draw a few frames: warm, and for knowing how
  // many make a batch by `clock`, and how many batches a block. What was held before is released.
  void hold(const Configuration& configuration,
            const std::array<std::vector<std::string>, 2>& faults, SideClock clock,
            const OnLoading& on_loading = {});
  [[nodiscard]] int frames_per_batch() const noexcept { return frames_per_batch_; }
  // How often a block takes its four batches.
  [[nodiscard]] int times_per_block() const noexcept { return times_per_block_; }
  // One block of what is held.
  [[nodiscard]] Block block();
  void release();

  // Both workers leave and new ones are opened; nothing is held.
  void restart();

 private:
  class Slot;
  // The four batches once more; of each what it took now counts where `block` has no less.
  void take_batches(Block& block);
  [[nodiscard]] Slot& slot(Side side) const { return *slots_.at(side == Side::a ? 0 : 1); }

  InterleavedOptions options_;
  core::Random random_;
  InterruptGuard interrupts_;
  std::array<std::unique_ptr<Slot>, 2> slots_;
  int frames_per_batch_ = 1;
  int times_per_block_ = 1;
};

}  // namespace triptych::measure
