#pragma once
// Deliberate faults. They are injected to prove that the gate detects faults, and that the death of
// a worker affects only one configuration.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/backend.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// A fault that is injected into the work: the name of a technique::Fault or a
// technique::ParticleFault, "slowdown:PERCENT" (real extra work), "crash", "hang", "device_lost" or
// "lost_counter".
struct InjectedFault {
  std::string fault;
  // Limits the fault to some configurations. Either a list of levels, such as
  // "technique=raycast,step=2", or a glob that matches configuration keys or device ids. Empty if
  // the fault applies everywhere.
  std::string only;
};

// Parses strings of the form "FAULT" or "FAULT@ONLY". Does not check whether a fault exists; use
// check_fault() for that.
[[nodiscard]] std::vector<InjectedFault> parse_faults(std::span<const std::string> faults);

// Returns the faults that apply to a configuration on a device.
[[nodiscard]] std::vector<std::string> faults_for(std::span<const InjectedFault> all,
                                                  const std::string& configuration,
                                                  const std::string& device);

// Returns a list of all faults for display, "half_voxel_shift, …, slowdown:PERCENT (0.01 to 100)".
[[nodiscard]] std::string fault_names();

// Throws an InputError that lists the known faults if the fault is unknown.
void check_fault(std::string_view fault);

// Injects a fault into the work, or executes the fault immediately: "crash" ends this process with
// SIGSEGV, "hang" never returns, "device_lost" throws DeviceLost. Throws NotSupported if the fault
// does not apply to this kind of work.
void inject(std::string_view fault, Work& work);

// Injects a fault into the record. "lost_counter" removes the first of Triptych's counters. All
// other faults leave the record unchanged.
void inject(std::string_view fault, record::Record& record);

}  // namespace triptych::measure
