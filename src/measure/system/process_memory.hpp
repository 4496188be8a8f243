#pragma once
// The memory that this process uses.

#include <cstdint>

namespace triptych::measure {

// Returns the peak memory of this process since its start, in bytes.
[[nodiscard]] std::uint64_t peak_memory_bytes();

// Returns the resident memory of this process in bytes, without the unused memory of its heap,
// which depends on chance. Returns 0 if /proc is unavailable.
[[nodiscard]] std::uint64_t resident_memory_bytes();

}  // namespace triptych::measure
