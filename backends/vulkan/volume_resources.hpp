#pragma once
// The data that every volume technique needs on the device: voxels, the transfer function, bricks
// and parameters.

#include <optional>
#include <string_view>

#include "backends/vulkan/descriptors.hpp"
#include "backends/vulkan/memory.hpp"
#include "backends/vulkan/pipeline.hpp"
#include "backends/vulkan/volume_parts.hpp"
#include "measure/contract/backend.hpp"
#include "technique/volume/brick_map.hpp"
#include "technique/volume/ray_trace.hpp"

namespace triptych::vulkan_backend {

// The bindings of technique/volume/raycast/parameters.glsl, and two that exist only in this
// backend.
enum Binding : std::uint32_t {
  parameters_binding = 0,
  volume_binding = 1,
  transfer_binding = 2,
  bricks_binding = 3,
  output_binding = 4,  // only for compute
  counters_binding = 5,
  quadrature_binding = 6,
  pauses_binding = 7  // used if the volume is drawn in parts
};

[[nodiscard]] vk::Format texture_format(scene::VoxelFormat format);

[[nodiscard]] Image upload_volume(const Gpu& gpu, const scene::VoxelGrid& grid);

[[nodiscard]] inline bool is_packed(const measure::VolumeWork& work) {
  return work.options.sampler == technique::Sampler::packed;
}

// The purpose of a pass over the image.
enum class Pass : std::uint8_t {
  timed,     // draws the image, and the injected extra work if there is any
  counting,  // draws only the image, with the counters bound
  tracing    // draws only the image, and records the history of one pixel
};

class VolumeResources {
 public:
  // If `output` is not null, binds it. The caller owns it.
  VolumeResources(const Gpu& gpu, const measure::VolumeWork& work, const Buffer* output)
      : VolumeResources(gpu, work, output,
                        technique::brick_map(work.scene, work.options.skip, work.options.adapt)) {}

  [[nodiscard]] const Layout& layout() const noexcept { return layout_; }
  [[nodiscard]] vk::DescriptorSet set(Pass pass) const;

  // Creates the counter buffer, with one block per pixel, and the descriptor set for
  // Pass::counting. Called once.
  void bind_counters();
  // Returns the number of parts of a volume that does not fit on the device as a whole; otherwise
  // 0.
  [[nodiscard]] int parts() const { return parts_ ? parts_->count() : 0; }
  void move_part(int n);
  // Creates a larger counter buffer that requests the history of pixel (x, y), and binds it.
  void bind_trace(int x, int y, int width);
  [[nodiscard]] technique::RayTrace read_trace() const;
  // Overwrites the counters if there are any.
  void poison_counters() const;
  // Sums the counters over all pixels, and adds the number of rays as "rays". Throws
  // measure::NotDrawn if the shader did not write the counters.
  [[nodiscard]] record::Counts read_counters() const;

 private:
  VolumeResources(const Gpu& gpu, const measure::VolumeWork& work, const Buffer* output,
                  std::span<const std::int32_t> map);
  VolumeResources(const Gpu& gpu, const measure::VolumeWork& work, const Buffer* output,
                  std::span<const std::int32_t> map, const std::vector<technique::Part>& parts);

  // The voxels and the transfer function as images. With the packed sampler, shaders instead read
  // them, the bricks and the quadrature from texel buffers.
  struct Images {
    Image volume;
    Image table;
    vk::raii::Sampler volume_sampler;
    vk::raii::Sampler nearest;
  };
  struct Texels {
    Buffer cells;
    Buffer table;
    vk::raii::BufferView cells_view;
    vk::raii::BufferView table_view;
    vk::raii::BufferView bricks_view;
    vk::raii::BufferView quadrature_view;
  };
  // `stored_cells` is the number of layers of cells along z in the largest part; 0 means that the
  // whole volume is uploaded.
  [[nodiscard]] Images make_images(const measure::VolumeWork& work, int stored_cells) const;
  [[nodiscard]] Texels make_texels(const measure::VolumeWork& work, int stored_cells) const;
  [[nodiscard]] Buffer make_parameters(const measure::VolumeWork& work,
                                       std::span<const std::int32_t> map,
                                       const std::vector<technique::Part>& parts);
  void write_set(Pass pass) const;
  void make_counters(std::size_t words);

  const Gpu& gpu_;
  std::size_t pixels_;
  const Buffer* output_;
  Buffer bricks_;
  Buffer quadrature_;
  std::optional<VolumeParts> parts_;
  std::optional<Buffer> pauses_;  // the states that rays keep from one part to the next
  Buffer parameters_;
  std::optional<Images> images_;
  std::optional<Texels> texels_;
  std::optional<Buffer> counters_;
  Layout layout_;
  vk::raii::DescriptorPool pool_;
  std::vector<vk::DescriptorSet> sets_;  // freed with the pool
};

[[nodiscard]] Constants constants_of(const measure::VolumeWork& work);

// Returns the SPIR-V of a raycaster that was compiled for this kind of work and pass. `shader` is
// "raycast.comp" or "raycast_fragment.frag". `in_parts` selects SPIR-V that draws a volume in
// parts, which only the technique raycast supports. Returns an empty string if no SPIR-V can trace
// the work.
[[nodiscard]] std::string_view raycast_spirv(std::string_view shader,
                                             const measure::VolumeWork& work, Pass pass,
                                             bool in_parts = false);

}  // namespace triptych::vulkan_backend
