#pragma once
// Collects what an OpenCL compiler reports about the kernels of programs.

#include <vector>

#include "backends/opencl/objects.hpp"
#include "backends/opencl/programs.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// Collects, for every kernel of these programs, its work-group info, the code that the driver
// printed while the program was built (measure/code/printed_kernels.hpp), and its line of the build
// log. Throws cl::Error, and core::NotSupported if there are no programs.
[[nodiscard]] measure::Compiled code_of(const Session& session,
                                        const std::vector<CapturedProgram>& programs);

}  // namespace triptych::opencl_backend
