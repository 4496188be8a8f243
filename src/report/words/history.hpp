#pragma once
// The sentences about the history of a device.

#include <optional>
#include <string>
#include <string_view>

#include "comparison/history.hpp"

namespace triptych::report::words {

// Formats the change of the times since the previous store and its interval: "1.02 [0.98, 1.07]
// (noise)". Returns "" if the times cannot be compared.
[[nodiscard]] std::string text_of(const std::optional<comparison::TimeChange>& change);
// States that the results of some configurations are based on another clock than before, although
// the history does not use it. Returns "" if all clocks are the same.
[[nodiscard]] std::string changed_clocks(const comparison::HistoryPoint& point);
// Explains the word "noise" in text_of().
[[nodiscard]] std::string_view noise_note();

}  // namespace triptych::report::words
