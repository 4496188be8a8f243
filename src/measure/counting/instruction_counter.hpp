#pragma once
// The worker's side of counting: how many instructions this process has executed, told by the
// emulator that it runs under (counting/emulator.hpp).

#include <array>
#include <cstdint>
#include <optional>

#include "measure/counting/protocol.h"
#include "record/record.hpp"

namespace triptych::measure {

// Over all threads. Reading it costs the process a few instructions of its own.
class InstructionCounter {
 public:
  // Since the process began, in the order of counting/protocol.h.
  using Snapshot = std::array<std::uint64_t, TRIPTYCH_COUNTS>;

  // nullopt where this process runs natively, or under another tool than ours.
  [[nodiscard]] static std::optional<InstructionCounter> of_this_process();

  [[nodiscard]] Snapshot now() const;

  // As record::Record::cost names them: "device_code", "driver", "libc", "program", "allocations",
  // "misses".
  [[nodiscard]] static record::Counts between(const Snapshot& before, const Snapshot& after);

  // Does `act`, keeps what it took and returns its result.
  template <typename Act>
  auto counting(record::Counts& taken, const Act& act) const {
    const Snapshot before = now();
    auto result = act();
    taken = between(before, now());
    return result;
  }

  // Returns when no other thread executes anything any more, or after two seconds: a driver's
  // thread that still writes a cache would be counted to the frame that comes next.
  void wait_until_quiet() const;

 private:
  InstructionCounter() = default;
};

}  // namespace triptych::measure
