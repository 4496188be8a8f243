#pragma once
#include <string>
#include <string_view>

namespace triptych::record {

// The id of the device with this number in the driver's list. The first device has the id `id`
// (Device::id), the second one "<id>#2", and so on.
[[nodiscard]] std::string numbered_id(std::string_view id, int number);

// The family of a device, derived from its id. Drivers that are the same program behind several
// interfaces belong to one family.
[[nodiscard]] std::string family_of(std::string_view device);

}  // namespace triptych::record
