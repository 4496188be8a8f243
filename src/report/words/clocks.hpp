#pragma once
// Sentences about the clocks of times.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/clock_counts.hpp"

namespace triptych::report::words {

// Describes in a few words whether the device's clocks are trusted: "trusted", "not trusted",
// "trusted for draw only", "none".
[[nodiscard]] std::string trust_of(const std::vector<record::ClockTrust>& clocks);

// States which clock the times of a device use: "gl:x: times use the device clock; in the previous
// run, they used the wall clock". `before` has no entry if the store has no previous run.
[[nodiscard]] std::string clocks_of(std::string_view device, const record::ClockCounts& now,
                                    const record::ClockCounts& before);

}  // namespace triptych::report::words
