#pragma once
#include <cstdint>
#include <span>

#include "core/error.hpp"

namespace triptych::measure {

// Thrown if a frame was not drawn although the driver reported it as finished. Either its outputs
// still have the values written by Prepared::poison(), or they differ from the outputs of an
// earlier frame that should be equal.
class NotDrawn : public core::Error {
 public:
  using core::Error::Error;
};

// Thrown if the driver did not provide a frame's pipeline statistics, although Triptych asked it to
// wait until they are available. All other results of the frame may be correct.
class StatisticsNotReady : public core::ApiError {
 public:
  using ApiError::ApiError;
};

// The value that backends write to buffers in Prepared::poison(). As a float it is NaN, and no
// counter reaches it.
inline constexpr std::uint32_t poison_word = 0xFFFFFFFF;

// Throws NotDrawn if all counters of a frame still contain poison_word. If only some of them do,
// the comparison with the expected counts detects the error.
void check_counted(std::span<const std::uint32_t> counters);

}  // namespace triptych::measure
