#pragma once
#include <cstdint>
#include <span>

#include "core/error.hpp"

namespace triptych::measure {

// A frame that the driver reported as finished was not drawn: its outputs still have the values of
// Prepared::poison(), or differ from those of an equal frame before it.
class NotDrawn : public core::Error {
 public:
  using core::Error::Error;
};

// The driver did not provide a frame's pipeline statistics although it was asked to wait for them.
// All other results of the frame may be right.
class StatisticsNotReady : public core::ApiError {
 public:
  using ApiError::ApiError;
};

// The value with which backends fill buffers in Prepared::poison(). As a float it is NaN, and no
// counter reaches it.
inline constexpr std::uint32_t poison_word = 0xFFFFFFFF;

// Throws NotDrawn if all counters of a frame still contain poison_word. If only some of them do,
// the comparison with the expected counts finds it.
void check_counted(std::span<const std::uint32_t> counters);

}  // namespace triptych::measure
