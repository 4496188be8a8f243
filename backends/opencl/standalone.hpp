#pragma once
#include <span>
#include <string>

#include "backends/opencl/programs.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// If a dump was requested (render --dump), writes frame.c to the dump folder. This program draws
// the frame with the technique raycast (or speed_of_light) and prints one of its pixels.
void dump_standalone(const Session& session, const measure::VolumeWork& work,
                     const std::string& source, const Constants& constants,
                     std::span<const std::int32_t> map);

}  // namespace triptych::opencl_backend
