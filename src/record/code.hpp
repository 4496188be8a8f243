#pragma once
// A compiler's report on the device code that it generated. The report is available without
// executing the code.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace triptych::record {

// One executable of a configuration: a shader stage of a pipeline, or a kernel.
struct Executable {
  // The keys are the driver's own names, such as "VGPRs" or "Inverse Throughput", and the names of
  // the statistics that Triptych counts in the disassembly ("Instructions" and those that begin
  // with "Loop"). A statistic that a driver does not report is absent, never zero.
  std::map<std::string, double> statistics;
  // The content hash of the disassembly, which is also its key for Store::listing(). If the
  // compiler is LLVM, the hash leaves out wait instructions, because their number varies from run
  // to run. Empty if there is no disassembly.
  std::string assembly = {};
  bool operator==(const Executable&) const = default;
};

// The keys are the names of shaders, such as "raycast.comp" or "sphere.frag", or of kernels.
using Code = std::map<std::string, Executable>;

void to_json(nlohmann::json& json, const Executable& executable);
void from_json(const nlohmann::json& json, Executable& executable);

}  // namespace triptych::record
