#pragma once
// Planted faults: to prove that the gate catches them and that a worker's death costs one
// configuration.

#include <string>
#include <string_view>
#include <vector>

#include "measure/backend.hpp"

namespace triptych::measure {

// Throws InputError for a name that is none of the faults, naming those there are.
void check_plant(std::string_view fault);

// Puts the fault into what is drawn, or does at once what it says: "crash" ends this process with
// SIGSEGV, "hang" never returns, "device_lost" throws DeviceLost. Throws NotSupported when this
// kind of work has no such fault.
void apply_plant(std::string_view fault, Work& work);

}  // namespace triptych::measure
