#pragma once
// Device code: SPIR-V that is built with the program and specialised when a technique is prepared.

#include <array>
#include <bit>
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backends/vulkan/descriptors.hpp"
#include "backends/vulkan/gpu.hpp"

namespace triptych::vulkan_backend {

// Specialization constants: word n has constant_id n.
class Specialization {
 public:
  // Constants from a structure of four-byte scalars.
  template <class Constants>
  explicit Specialization(const Constants& constants) {
    const auto words =
        std::bit_cast<std::array<std::int32_t, sizeof(Constants) / sizeof(std::int32_t)>>(
            constants);
    words_.assign(words.begin(), words.end());
    for (std::uint32_t i = 0; i < words_.size(); ++i) {
      entries_.push_back({.constantID = i, .offset = 4 * i, .size = 4});
    }
  }
  // Valid as long as this object exists.
  [[nodiscard]] vk::SpecializationInfo info() const;
  [[nodiscard]] std::span<const std::int32_t> words() const noexcept { return words_; }

 private:
  std::vector<std::int32_t> words_;
  std::vector<vk::SpecializationMapEntry> entries_;
};

// The constants of the volume techniques, in the order of their numbers in shaders/prelude.glsl.
struct Constants {
  std::int32_t manual_sampler = 1;
  std::int32_t shading = 0;
  std::int32_t speed_of_light = 0;
  std::int32_t fault = 0;
  std::int32_t opacity_form = 0;
  std::int32_t preintegrated = 0;  // technique::preintegration_form
  std::int32_t leaps = 0;
  std::int32_t adapt = 0;
  std::int32_t voxel_bits = 32;
};
static_assert(sizeof(Constants) == 9 * 4);

// The embedded SPIR-V, by the name of its file: "raycast.comp.spv".
[[nodiscard]] std::string_view spirv(std::string_view name);
// Returns the name of its file without the ending: "raycast.comp".
[[nodiscard]] std::string shader_name(std::string_view code);
// A module, from the bytes of a SPIR-V file.
[[nodiscard]] vk::raii::ShaderModule make_shader(const Gpu& gpu, std::string_view code);

// The Gpu owns the pipeline (Pipelines); it is created if there is none of this kind yet.
[[nodiscard]] vk::Pipeline compute_pipeline(const Gpu& gpu, const Layout& layout,
                                            std::string_view code, const Specialization& constants);
[[nodiscard]] inline vk::Pipeline compute_pipeline(const Gpu& gpu, const Layout& layout,
                                                   std::string_view code,
                                                   const Constants& constants) {
  return compute_pipeline(gpu, layout, code, Specialization(constants));
}

// If device code is to be dumped, writes the SPIR-V of one stage with its constants and the time
// for creating its pipeline, which began at `begin`.
void dump_shader(vk::ShaderStageFlagBits stage, std::string_view code,
                 const Specialization& constants, std::chrono::steady_clock::time_point begin);

// The content hash of the SPIR-V and the constants.
[[nodiscard]] std::string code_hash(std::string_view code, const Constants& constants);
[[nodiscard]] std::string code_hash(std::span<const std::string_view> codes,
                                    const Specialization& constants);

}  // namespace triptych::vulkan_backend
