#pragma once
// The worker's part in counting instructions: it asks the emulator under which it runs
// (counting/emulator.hpp) how many instructions this process has executed.

#include <array>
#include <cstdint>
#include <optional>

#include "measure/counting/protocol.h"
#include "record/record.hpp"

namespace triptych::measure {

// Counts the instructions of all threads. Reading the counter itself takes a few instructions.
class InstructionCounter {
 public:
  // Counts since the process began, in the order of counting/protocol.h.
  using Snapshot = std::array<std::uint64_t, TRIPTYCH_COUNTS>;

  // Returns nullopt if this process does not run under the emulator, or runs under another Valgrind
  // tool.
  [[nodiscard]] static std::optional<InstructionCounter> of_this_process();

  [[nodiscard]] Snapshot read() const;

  // Returns the difference between the snapshots. The names are those of record::Record::cost:
  // "device_code", "driver", "libc", "program", "allocations", "misses".
  [[nodiscard]] static record::Counts between(const Snapshot& before, const Snapshot& after);

  // Runs `act`, stores the counts in `taken` and returns the result of `act`.
  template <typename Action>
  auto count(record::Counts& taken, const Action& action) const {
    const Snapshot before = read();
    auto result = action();
    taken = between(before, read());
    return result;
  }

  // Waits until no other thread executes instructions, but no longer than two seconds. Otherwise,
  // the count of the next frame would include the instructions of a driver thread that is still
  // writing a cache.
  void wait_until_quiet() const;

 private:
  InstructionCounter() = default;
};

}  // namespace triptych::measure
