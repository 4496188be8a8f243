#pragma once
// Device code: SPIR-V that is embedded in the program and specialised when a technique is prepared.

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

// Specialization constants. Word n has the constant_id n.
class Specialization {
 public:
  // Reads the constants from a structure of four-byte scalars.
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
  // The result is valid as long as this object exists.
  [[nodiscard]] vk::SpecializationInfo info() const;
  [[nodiscard]] std::span<const std::int32_t> words() const noexcept { return words_; }

 private:
  std::vector<std::int32_t> words_;
  std::vector<vk::SpecializationMapEntry> entries_;
};

// The constants of the volume techniques, in the order of their ids in shaders/prelude.glsl.
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

// Returns the embedded SPIR-V with this file name, such as "raycast.comp.spv".
[[nodiscard]] std::string_view spirv(std::string_view name);
// Returns the file name of the shader without its ".spv" extension: "raycast.comp".
[[nodiscard]] std::string shader_name(std::string_view code);
// Creates a module from the contents of a SPIR-V file.
[[nodiscard]] vk::raii::ShaderModule make_shader(const Gpu& gpu, std::string_view code);

// Returns the pipeline for this code. The Gpu owns the pipeline (Pipelines) and creates it unless
// the same pipeline already exists.
[[nodiscard]] vk::Pipeline compute_pipeline(const Gpu& gpu, const Layout& layout,
                                            std::string_view code, const Specialization& constants);
[[nodiscard]] inline vk::Pipeline compute_pipeline(const Gpu& gpu, const Layout& layout,
                                                   std::string_view code,
                                                   const Constants& constants) {
  return compute_pipeline(gpu, layout, code, Specialization(constants));
}

// If a dump was requested, writes the SPIR-V and the constants of one stage, and the time that the
// creation of its pipeline took, which is the time since `begin`.
void dump_shader(vk::ShaderStageFlagBits stage, std::string_view code,
                 const Specialization& constants, std::chrono::steady_clock::time_point begin);

// Returns the content hash of the SPIR-V and the constants.
[[nodiscard]] std::string code_hash(std::string_view code, const Constants& constants);
[[nodiscard]] std::string code_hash(std::span<const std::string_view> codes,
                                    const Specialization& constants);

}  // namespace triptych::vulkan_backend
