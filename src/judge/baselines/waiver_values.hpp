#pragma once
// Values in entries that excuse something, in whichever file they are.

#include <initializer_list>
#include <string>
#include <string_view>

#include "core/json_file.hpp"

namespace triptych::judge {

// Refuses unknown keys: an entry with a key that nobody reads would excuse more than it says.
void refuse_other_keys(const core::JsonNode& entry, std::initializer_list<std::string_view> known);
// Must not be blank.
[[nodiscard]] std::string reason_of(const core::JsonNode& entry);
// Must be a day of the calendar.
[[nodiscard]] std::string expiry_of(const core::JsonNode& entry);
// Whether a glob excludes nothing, however it is written: it matches texts that have nothing in
// common.
[[nodiscard]] bool matches_everything(std::string_view glob);

}  // namespace triptych::judge
