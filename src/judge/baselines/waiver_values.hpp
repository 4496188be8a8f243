#pragma once
// Reads and checks the fields that two kinds of entries have in common: waivers, which excuse known
// failures, and entries for devices that are absent on purpose.

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "core/json_file.hpp"

namespace triptych::judge {

// Throws InputError for an unknown key, because an entry whose key is ignored would excuse more
// than intended.
void refuse_unknown_keys(const core::JsonNode& entry,
                         std::initializer_list<std::string_view> known);
// Returns the reason of the entry. Throws InputError if it is blank.
[[nodiscard]] std::string reason_of(const core::JsonNode& entry);
// Returns the expiry date of the entry. Throws InputError if it is not a valid calendar date.
[[nodiscard]] std::string expiry_of(const core::JsonNode& entry);
// Returns nullopt unless both arguments are ISO dates.
[[nodiscard]] std::optional<int> days_between(std::string_view from, std::string_view to);
// Throws InputError for an expiry date that is more than a year after `today` (an ISO date),
// because such an entry would in practice never be reviewed.
void refuse_distant_expiry(const core::JsonNode& expiry, const std::string& today);
// Returns whether a glob matches every device, host, test or configuration, regardless of how it is
// written. For example, not only "*" but also "*:*" matches every device.
[[nodiscard]] bool matches_every_device(std::string_view glob);
[[nodiscard]] bool matches_every_host(std::string_view glob);
[[nodiscard]] bool matches_every_test(std::string_view glob);
[[nodiscard]] bool matches_every_configuration(std::string_view glob);

}  // namespace triptych::judge
