#pragma once
// Input that is broken – a file, or levels that do not go together – is no fault of the device, and
// no device could draw it: its configurations are skipped, with a reason that says so, and cannot
// be judged.

#include <string_view>

#include "core/error.hpp"
#include "record/record.hpp"

namespace triptych::record {

// What such a reason begins with.
inline constexpr std::string_view bad_input = "bad input: ";

[[nodiscard]] inline bool has_bad_input(const Record& record) {
  return record.outcome == Outcome::skipped && record.reason.starts_with(bad_input);
}

// Throws the reason of a record that was skipped: InputError for bad input, else NotSupported.
inline void require_drawable(const Record& record) {
  if (record.outcome != Outcome::skipped) return;
  if (has_bad_input(record)) throw core::InputError(record.reason);
  throw core::NotSupported(record.reason);
}

}  // namespace triptych::record
