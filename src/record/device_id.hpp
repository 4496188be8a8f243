#pragma once
#include <string>
#include <string_view>

namespace triptych::record {

// Returns the id of the device with this 1-based number in the driver's list. The first device has
// the id `id`, the second device has the id "<id>#2", and so on.
[[nodiscard]] std::string numbered_id(std::string_view id, int number);

// Returns the family of a device, which is derived from its id. Drivers for different APIs that
// share their implementation, such as lavapipe and llvmpipe, belong to one family.
[[nodiscard]] std::string family_of(std::string_view device);

}  // namespace triptych::record
