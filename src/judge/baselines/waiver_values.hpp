#pragma once
// Values of entries that excuse something, whichever file they are in.

#include <initializer_list>
#include <string>
#include <string_view>

#include "core/json_file.hpp"

namespace triptych::judge {

// A key that nobody reads would leave an entry that excuses more than it says.
void refuse_other_keys(const core::JsonNode& entry, std::initializer_list<std::string_view> known);
// Not blank.
[[nodiscard]] std::string reason_of(const core::JsonNode& entry);
// A day of the calendar.
[[nodiscard]] std::string expiry_of(const core::JsonNode& entry);
// A glob that leaves nothing out, however it is spelled: it matches texts that have nothing in
// common.
[[nodiscard]] bool matches_everything(std::string_view glob);

}  // namespace triptych::judge
