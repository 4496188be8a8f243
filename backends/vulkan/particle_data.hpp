#pragma once
// The data that every particle technique needs on the device: the particles in the order of
// technique::Arrangement, the parameters and the counters.

#include <cstdint>
#include <vector>

#include "backends/vulkan/descriptors.hpp"
#include "backends/vulkan/memory.hpp"
#include "backends/vulkan/pipeline.hpp"
#include "measure/contract/backend.hpp"
#include "technique/catalogue.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::vulkan_backend {

// The bindings of technique/particles/*.glsl.
enum ParticleBinding : std::uint32_t {
  particle_parameters_binding = 0,
  particle_transfer_binding = 1,
  particle_counters_binding = 2,
  spheres_binding = 3,
  colours_binding = 4,
  ids_binding = 5,
  cells_binding = 6,
  first_free_binding = 7  // a technique's own bindings begin here
};

// The specialization constants, in the order of their ids in shaders/particle_prelude.glsl.
struct ParticleConstants {
  std::int32_t colour = 0;
  std::int32_t transfer_at_pixel = 0;
  std::int32_t ray_at_vertex = 0;
  std::int32_t fault = 0;
  float largest_point = 1;  // in pixels
  float point_margin = 0;
  float sprite_growth = 0;
};
[[nodiscard]] ParticleConstants particle_constants(const Gpu& gpu,
                                                   const measure::ParticleWork& work);

// Returns the number of pixels that must be added to the size of a point so that this device draws
// at least the intended square.
[[nodiscard]] float point_margin(const Gpu& gpu);
// Returns the edge length, in pixels, of the largest square that this device can draw as a point.
// It is the device's largest point size minus point_margin().
[[nodiscard]] float largest_point(const Gpu& gpu);

// Returns the vertex attribute format of a particle's colour.
[[nodiscard]] vk::Format colour_format(scene::ColourKind kind);
[[nodiscard]] std::uint32_t colour_bytes(scene::ColourKind kind);

// How shaders read particles: as vertex attributes, or from storage buffers.
enum class Fetch : std::uint8_t { attributes, by_index };

// Buffers in device memory. They do not refer to host memory.
class ParticleData {
 public:
  ParticleData(const Gpu& gpu, const measure::ParticleWork& work,
               const technique::Arrangement& arrangement);

  [[nodiscard]] std::uint32_t particles() const noexcept { return particles_; }
  [[nodiscard]] std::uint32_t cells() const noexcept { return cells_; }
  [[nodiscard]] const Buffer& spheres() const noexcept { return spheres_; }
  [[nodiscard]] const Buffer& colours() const noexcept { return colours_; }
  [[nodiscard]] const Buffer& ids() const noexcept { return ids_; }

  // Writes all bindings below first_free_binding to the set. Writes the bindings of the particles
  // only if they are fetched by index, because a vertex buffer may be larger than a storage buffer.
  void bind(vk::DescriptorSet set, Fetch fetch) const;

  // Uses the camera of this scene for all later frames.
  void upload_camera(const measure::ParticleWork& work) const;

  void poison_counters() const;
  void clear_counters(const vk::raii::CommandBuffer& commands) const;
  // Returns the counters of a frame whose shaders counted their work. The device must have finished
  // that frame.
  [[nodiscard]] record::Counts counts(technique::Method method, technique::Culling culling,
                                      const core::Image& image) const;

 private:
  const Gpu& gpu_;
  std::uint32_t particles_;
  std::uint32_t cells_;
  Buffer parameters_;
  Buffer transfer_;
  Buffer counters_;
  Buffer spheres_;
  Buffer colours_;
  Buffer ids_;
  Buffer cell_boxes_;
};

// Returns the bindings that ParticleData::bind writes.
[[nodiscard]] std::vector<vk::DescriptorSetLayoutBinding> particle_bindings();
[[nodiscard]] vk::DescriptorSetLayoutBinding storage_binding(std::uint32_t number,
                                                             vk::ShaderStageFlags stages);

}  // namespace triptych::vulkan_backend
