#include "measure/counting/instruction_counter.hpp"

#include <dlfcn.h>
#include <valgrind/valgrind.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <thread>

namespace triptych::measure {
namespace {

// The names of the counts, in the order of protocol.h.
constexpr std::array<const char*, TRIPTYCH_COUNTS> names{"device_code", "driver",      "libc",
                                                         "program",     "allocations", "misses"};

// Functions that allocate memory; calls that free it are not counted.
constexpr std::array<const char*, 6> allocators{"malloc",        "calloc",         "realloc",
                                                "aligned_alloc", "posix_memalign", "memalign"};

// Sends a request to the emulator and returns whether it was handled. Without the emulator, the
// request consists of five instructions that have no effect, and the result is false.
bool request(unsigned operation, std::uintptr_t value) {
  return VALGRIND_DO_CLIENT_REQUEST_EXPR(0, VG_USERREQ_TOOL_BASE('T', 'Y') + operation, value, 0, 0,
                                         0, 0) == TRIPTYCH_COUNTS;
}

}  // namespace

std::optional<InstructionCounter> InstructionCounter::of_this_process() {
  Snapshot snapshot{};
  if (!request(TRIPTYCH_READ_COUNTS, reinterpret_cast<std::uintptr_t>(snapshot.data())))
    return std::nullopt;
  for (const char* name : allocators) {
    if (const void* address = ::dlsym(RTLD_DEFAULT, name)) {
      request(TRIPTYCH_FUNCTION, reinterpret_cast<std::uintptr_t>(address));
    }
  }
  return InstructionCounter();
}

InstructionCounter::Snapshot InstructionCounter::read() const {
  Snapshot snapshot{};
  request(TRIPTYCH_READ_COUNTS, reinterpret_cast<std::uintptr_t>(snapshot.data()));
  return snapshot;
}

record::Counts InstructionCounter::between(const Snapshot& before, const Snapshot& after) {
  record::Counts counts;
  for (std::size_t i = 0; i < after.size(); ++i) counts[names[i]] = after[i] - before[i];
  return counts;
}

// Reads the counter again and again. This thread itself executes a few hundred instructions each
// time it falls asleep and wakes up. Therefore the process counts as quiet if it has executed fewer
// than `own` instructions since the previous reading.
void InstructionCounter::wait_until_quiet() const {
  constexpr std::uint64_t own_instructions = 2000;
  constexpr std::chrono::milliseconds pause{2};
  constexpr int at_most = 1000;
  constexpr int in_a_row = 3;
  const auto total = [this] {
    const Snapshot counts = read();
    return std::reduce(counts.begin(), counts.end());
  };
  std::uint64_t before = total();
  for (int i = 0, quiet = 0; i < at_most && quiet < in_a_row; ++i) {
    std::this_thread::sleep_for(pause);
    const std::uint64_t after = total();
    quiet = after - before < own_instructions ? quiet + 1 : 0;
    before = after;
  }
}

}  // namespace triptych::measure
