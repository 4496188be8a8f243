#include "measure/counting/instruction_counter.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdint>

#include "core/error.hpp"

namespace triptych::measure {
namespace {

// In the order of protocol.h.
constexpr std::array<const char*, TRIPTYCH_COUNTS> names{"device_code", "driver", "libc", "program",
                                                         "allocations"};

// What memory is asked for by; freeing is not counted.
constexpr std::array<const char*, 6> allocators{"malloc",        "calloc",         "realloc",
                                                "aligned_alloc", "posix_memalign", "memalign"};

void mark(long operation, std::uintptr_t value) {
  ::syscall(TRIPTYCH_MARK, operation, value);
}

// Once in a process: the emulator translates everything anew for it.
void count_allocations() {
  for (const char* name : allocators) {
    if (const void* address = ::dlsym(RTLD_DEFAULT, name)) {
      mark(TRIPTYCH_FUNCTION, reinterpret_cast<std::uintptr_t>(address));
    }
  }
  mark(TRIPTYCH_FUNCTIONS_DONE, 0);
}

}  // namespace

std::optional<InstructionCounter> InstructionCounter::of_this_process() {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) {
    throw core::IoError("cannot make a pipe for instruction counts");
  }
  InstructionCounter counter{FileDescriptor(ends[0]), FileDescriptor(ends[1])};
  if (!counter.ask()) return std::nullopt;
  count_allocations();
  return counter;
}

InstructionCounter::Snapshot InstructionCounter::now() const {
  if (const auto counts = ask()) return *counts;
  throw core::IoError("the emulator does not tell its instruction counts");
}

record::Counts InstructionCounter::between(const Snapshot& before, const Snapshot& after) {
  record::Counts counts;
  for (std::size_t i = 0; i < after.size(); ++i) counts[names[i]] = after[i] - before[i];
  return counts;
}

// Where the plugin is there it has written before the call returns.
std::optional<InstructionCounter::Snapshot> InstructionCounter::ask() const {
  mark(TRIPTYCH_TELL, static_cast<std::uintptr_t>(write_.get()));
  Snapshot told{};
  if (::read(read_.get(), told.data(), sizeof told) != static_cast<ssize_t>(sizeof told)) {
    return std::nullopt;
  }
  return told;
}

}  // namespace triptych::measure
