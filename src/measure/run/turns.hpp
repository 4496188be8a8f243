#pragma once
// Two workers that take turns on one machine, so that whatever slows the machine down slows both.
// Blocks of turns in random order, A B B A or B A A B: a drift that is linear over four turns
// cancels out of their difference. Short turns are taken so several times, and the least of each
// of the four counts: what disturbs one side's processor and not the other's comes and goes within
// tens of milliseconds, and only adds.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
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
class SideEnded : public core::Error {
 public:
  SideEnded(Side side, record::Outcome outcome, const std::string& reason);
  [[nodiscard]] Side side() const noexcept { return side_; }
  [[nodiscard]] record::Outcome outcome() const noexcept { return outcome_; }

 private:
  Side side_;
  record::Outcome outcome_;
};

// Mean time of a frame in each of a side's two turns, the least of those that a block took so.
struct SideTimes {
  std::array<double, 2> wall_ns{};
  std::optional<std::array<double, 2>> device_ns;  // where the device told it of every frame
};

struct Block {
  bool b_first = false;  // B A A B
  SideTimes a;
  SideTimes b;
};

enum class TurnClock : std::uint8_t { wall, device };

// d = ½(ln b₁ + ln b₂ − ln a₁ − ln a₂) of each block. Device times must be there for
// TurnClock::device; a time of nothing counts as a nanosecond.
[[nodiscard]] std::vector<double> differences(std::span<const Block> blocks, TurnClock clock);

// Whether the device times of both sides can be true at all (plausible(),
// measure/protocol/clock.hpp).
[[nodiscard]] bool device_clock_holds(std::span<const Block> blocks);

struct TurnOptions {
  std::string suite;
  std::vector<std::string> kinds;        // of work that the plan needs: their clocks are calibrated
  std::chrono::seconds limit{60};        // of one answer; a worker past it is killed
  std::chrono::seconds start_limit{60};  // of opening a device and calibrating its clocks
  // Shorter frames are batched, as many on either side, until a turn lasts this long.
  double least_turn_ns = 1e6;
  // The four turns are taken again until a block lasts this long.
  double least_block_ns = 40e6;
  std::uint64_t seed = 1;  // of the blocks' orders
};

class Turns {
 public:
  // Opens both. Throws InputError for an environment that forbids measuring, NotSupported with the
  // reason when a side cannot be opened.
  Turns(TurnOptions options, const SideOptions& a, const SideOptions& b);
  ~Turns();
  Turns(const Turns&) = delete;
  Turns& operator=(const Turns&) = delete;

  // Device and clocks, as the first worker of the side told them.
  [[nodiscard]] const Hello& hello(Side side) const;

  // All that follow throw SideEnded, and Interrupted when a signal asks to stop.

  // Both sides prepare the configuration, keep it and draw a few frames: warm, and for knowing how
  // many make a turn by `clock`, and how many turns a block. What was held before is released.
  void hold(const Configuration& configuration,
            const std::array<std::vector<std::string>, 2>& plants, TurnClock clock,
            const OnLoading& on_loading = {});
  [[nodiscard]] int frames_per_turn() const noexcept { return frames_per_turn_; }
  // How often a block takes its four turns.
  [[nodiscard]] int times_per_block() const noexcept { return times_per_block_; }
  // One block of what is held.
  [[nodiscard]] Block block();
  void release();

  // Both workers leave and new ones are opened; nothing is held.
  void relaunch();

 private:
  class Seat;
  // The four turns once more; of each what it took now counts where `block` has no less.
  void take_turns(Block& block);
  [[nodiscard]] Seat& seat(Side side) const { return *seats_.at(side == Side::a ? 0 : 1); }

  TurnOptions options_;
  core::Random random_;
  InterruptGuard interrupts_;
  std::array<std::unique_ptr<Seat>, 2> seats_;
  int frames_per_turn_ = 1;
  int times_per_block_ = 1;
};

}  // namespace triptych::measure
