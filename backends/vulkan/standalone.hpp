#pragma once
#include <cstdint>
#include <string_view>

#include "backends/vulkan/pipeline.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::vulkan_backend {

// If a dump was requested (render --dump), writes frame.c to the dump folder. This program draws
// the frame with the technique raycast (or speed_of_light) and prints one of its pixels. groups_x
// and groups_y are the numbers of work groups to dispatch.
void dump_standalone(const measure::VolumeWork& work, std::string_view code,
                     const Constants& constants, std::uint32_t groups_x, std::uint32_t groups_y);

}  // namespace triptych::vulkan_backend
