#pragma once
#include <string>
#include <string_view>

namespace triptych::record {

// A driver lists its devices in some order. The first one has the id `id` (Device::id), the second
// one "<id>#2", and so on.
[[nodiscard]] std::string numbered_id(std::string_view id, int number);

// The family of a device, from its id. Drivers that are the same program behind several interfaces
// are one family.
[[nodiscard]] std::string family_of(std::string_view device);

}  // namespace triptych::record
