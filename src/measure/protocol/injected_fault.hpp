#pragma once
// Injected faults: to prove that the gate catches them and that a worker's death costs one
// configuration.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/backend.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// A fault put into what is measured, to prove that the gate catches it: a technique::Fault by
// name, "slowdown:PERCENT" (real extra work), "crash", "hang", "device_lost", "lost_counter".
struct InjectedFault {
  std::string fault;
  // Levels, "technique=raycast,step=2", or a glob over configuration keys and device ids; empty:
  // everywhere.
  std::string only;
};

// "FAULT" or "FAULT@ONLY" each; whether there is such a fault is not asked (check_fault).
[[nodiscard]] std::vector<InjectedFault> parse_faults(std::span<const std::string> faults);

// The faults of those that are meant for a configuration on a device.
[[nodiscard]] std::vector<std::string> faults_for(std::span<const InjectedFault> all,
                                                  const std::string& configuration,
                                                  const std::string& device);

// "half_voxel_shift, …, slowdown:PERCENT (0.01 to 100)".
[[nodiscard]] std::string fault_names();

// Throws InputError for a name that is none of the faults, naming those there are.
void check_fault(std::string_view fault);

// Puts the fault into what is drawn, or does at once what it says: "crash" ends this process with
// SIGSEGV, "hang" never returns, "device_lost" throws DeviceLost. Throws NotSupported when this
// kind of work has no such fault.
void inject(std::string_view fault, Work& work);

// "lost_counter" takes the first of our own counters away; other faults change nothing here.
void inject(std::string_view fault, record::Record& record);

}  // namespace triptych::measure
