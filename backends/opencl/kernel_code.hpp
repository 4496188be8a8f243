#pragma once
// Collects what an OpenCL compiler reports about the kernels of programs.

#include <vector>

#include "backends/opencl/objects.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// Collects, for every kernel of these programs, its work-group info, the text that the driver prints
// while the kernel is created (rusticl on radeonsi with AMD_DEBUG=cs,asm), and its line of the build
// log. Throws cl::Error, and core::NotSupported if there are no programs.
[[nodiscard]] measure::Compiled code_of(const Session& session,
                                        const std::vector<cl::Program>& programs);

}  // namespace triptych::opencl_backend
