#pragma once
// The worker's side of counting: the number of instructions that this process has executed,
// reported by the emulator that it runs under (counting/emulator.hpp).

#include <array>
#include <cstdint>
#include <optional>

#include "measure/counting/protocol.h"
#include "record/record.hpp"

namespace triptych::measure {

// Counts over all threads. Reading the counter costs the process a few instructions.
class InstructionCounter {
 public:
  // Counts since the process began, in the order of counting/protocol.h.
  using Snapshot = std::array<std::uint64_t, TRIPTYCH_COUNTS>;

  // nullopt if this process runs natively, or under another tool.
  [[nodiscard]] static std::optional<InstructionCounter> of_this_process();

  [[nodiscard]] Snapshot now() const;

  // The names are those of record::Record::cost: "device_code", "driver", "libc", "program",
  // "allocations", "misses".
  [[nodiscard]] static record::Counts between(const Snapshot& before, const Snapshot& after);

  // Runs `act`, stores the counts in `taken` and returns the result of `act`.
  template <typename Act>
  auto counting(record::Counts& taken, const Act& act) const {
    const Snapshot before = now();
    auto result = act();
    taken = between(before, now());
    return result;
  }

  // Returns when no other thread executes instructions any more, but after two seconds at the
  // latest. Without this wait, the instructions of a driver's thread that still writes a cache
  // would be counted with the next frame.
  void wait_until_quiet() const;

 private:
  InstructionCounter() = default;
};

}  // namespace triptych::measure
