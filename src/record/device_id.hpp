#pragma once
#include <string>
#include <string_view>

namespace triptych::record {

// The id (Device::id) of a driver's devices in the order it lists them: the first is `id`, the
// second "<id>#2".
[[nodiscard]] std::string numbered_id(std::string_view id, int number);

// Of a device's id. Drivers that are one program behind several interfaces are one family.
[[nodiscard]] std::string family_of(std::string_view device);

}  // namespace triptych::record
