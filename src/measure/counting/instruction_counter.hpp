#pragma once
// The worker's side of counting: how many instructions this process has executed, told by the
// emulator that it runs under (counting/emulator.hpp).

#include <optional>
#include <utility>

#include "measure/process.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// Counts are those of record::Record::cost: "device_code", "driver", "libc", "program" and
// "allocations", over all threads. Reading them costs the process a few hundred instructions of its
// own, which count as its own and libc's.
class InstructionCounter {
 public:
  // nullopt where this process runs natively, or under an emulator without our plugin. Throws
  // IoError when no pipe can be made.
  [[nodiscard]] static std::optional<InstructionCounter> of_this_process();

  // Since the process began. Throws IoError when the emulator does not answer.
  [[nodiscard]] record::Counts so_far() const;

  // What `act` took; its result is kept beside.
  template <typename Act>
  auto counting(record::Counts& taken, const Act& act) const {
    const record::Counts before = so_far();
    auto result = act();
    taken = difference(before, so_far());
    return result;
  }

  [[nodiscard]] static record::Counts difference(const record::Counts& before,
                                                 const record::Counts& after);

 private:
  InstructionCounter(FileDescriptor read, FileDescriptor write)
      : read_(std::move(read)), write_(std::move(write)) {}
  [[nodiscard]] std::optional<record::Counts> ask() const;

  FileDescriptor read_;   // non-blocking
  FileDescriptor write_;  // the emulator writes to it
};

}  // namespace triptych::measure
