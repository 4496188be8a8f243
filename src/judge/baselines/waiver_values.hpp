#pragma once
// Reads values that waivers and entries for absent devices have in common.

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "core/json_file.hpp"

namespace triptych::judge {

// Refuses unknown keys, because an entry with an ignored key would excuse more than intended.
void refuse_other_keys(const core::JsonNode& entry, std::initializer_list<std::string_view> known);
// Must not be blank.
[[nodiscard]] std::string reason_of(const core::JsonNode& entry);
// Must be a day of the calendar.
[[nodiscard]] std::string expiry_of(const core::JsonNode& entry);
// nullopt unless both are ISO dates.
[[nodiscard]] std::optional<int> days_between(std::string_view from, std::string_view to);
// Refuses an expiry date that is more than a year after `today` (an ISO date), because such an
// entry would in practice never expire.
void refuse_distant_expiry(const core::JsonNode& expiry, const std::string& today);
// Whether a glob matches every device or every host, however it is written: "*:*" matches every
// device.
[[nodiscard]] bool matches_every_device(std::string_view glob);
[[nodiscard]] bool matches_every_host(std::string_view glob);
[[nodiscard]] bool matches_every_test(std::string_view glob);
[[nodiscard]] bool matches_every_configuration(std::string_view glob);

}  // namespace triptych::judge
