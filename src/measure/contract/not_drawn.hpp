#pragma once
#include <cstdint>
#include <span>

#include "core/error.hpp"

namespace triptych::measure {

// A frame that the driver reported as finished did not draw: what it writes still holds the values
// of Prepared::poison(), or differs from what an equal frame before it wrote.
class NotDrawn : public core::Error {
 public:
  using core::Error::Error;
};

// The driver did not give a frame's pipeline statistics although it was asked to wait for them. The
// image and all else of the frame may be right.
class StatisticsNotReady : public core::ApiError {
 public:
  using ApiError::ApiError;
};

// What backends fill buffers with in Prepared::poison(): NaN as a float. No counter reaches it.
inline constexpr std::uint32_t poison_word = 0xFFFFFFFF;

// Throws NotDrawn when all of a frame's counters still hold poison_word. Some that do are left to
// the comparison with the expected counts.
void check_counted(std::span<const std::uint32_t> counters);

}  // namespace triptych::measure
