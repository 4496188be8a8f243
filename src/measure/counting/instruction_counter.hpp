#pragma once
// The worker's side of counting: how many instructions this process has executed, told by the
// emulator that it runs under (counting/emulator.hpp).

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "measure/counting/protocol.h"
#include "measure/process.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// Over all threads. Reading it costs the process a few hundred instructions of its own, which count
// as its own and libc's.
class InstructionCounter {
 public:
  // Since the process began, in the order of counting/protocol.h.
  using Snapshot = std::array<std::uint64_t, TRIPTYCH_COUNTS>;

  // nullopt where this process runs natively, or under an emulator without our plugin. Throws
  // IoError when no pipe can be made.
  [[nodiscard]] static std::optional<InstructionCounter> of_this_process();

  // Throws IoError when the emulator does not answer.
  [[nodiscard]] Snapshot now() const;

  // As record::Record::cost names them: "device_code", "driver", "libc", "program", "allocations".
  [[nodiscard]] static record::Counts between(const Snapshot& before, const Snapshot& after);

  // Does `act`, keeps what it took and returns its result.
  template <typename Act>
  auto counting(record::Counts& taken, const Act& act) const {
    const Snapshot before = now();
    auto result = act();
    taken = between(before, now());
    return result;
  }

 private:
  InstructionCounter(FileDescriptor read, FileDescriptor write)
      : read_(std::move(read)), write_(std::move(write)) {}
  [[nodiscard]] std::optional<Snapshot> ask() const;

  FileDescriptor read_;   // non-blocking
  FileDescriptor write_;  // the emulator writes to it
};

}  // namespace triptych::measure
