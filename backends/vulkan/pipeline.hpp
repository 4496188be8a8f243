#pragma once
// Device code: SPIR-V built with the program, specialised when a technique is prepared.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "backends/vulkan/descriptors.hpp"
#include "backends/vulkan/gpu.hpp"

namespace triptych::vulkan_backend {

// Specialization constants in the order of their numbers in shaders/prelude.glsl.
struct Constants {
  std::int32_t manual_sampler = 1;
  std::int32_t shading = 0;
  std::int32_t speed_of_light = 0;
  std::int32_t fault = 0;
  std::int32_t opacity_form = 0;
};
static_assert(sizeof(Constants) == 5 * 4);

// The embedded SPIR-V by its file name, "raycast.comp.spv".
[[nodiscard]] std::string_view spirv(std::string_view name);
// A module from the bytes of a SPIR-V file.
[[nodiscard]] vk::raii::ShaderModule make_shader(const Gpu& gpu, std::string_view code);

[[nodiscard]] vk::raii::Pipeline make_compute_pipeline(const Gpu& gpu, const Layout& layout,
                                                       std::string_view code,
                                                       const Constants& constants);

// Content hash of the SPIR-V and the constants.
[[nodiscard]] std::string code_hash(std::string_view code, const Constants& constants);

// Map entries for vk::SpecializationInfo over Constants.
[[nodiscard]] const std::array<vk::SpecializationMapEntry, 5>& constant_entries();

}  // namespace triptych::vulkan_backend
