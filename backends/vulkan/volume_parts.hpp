#pragma once
// A volume of which the device stores only one part at a time (technique/volume/parts.hpp).

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "backends/vulkan/memory.hpp"
#include "measure/contract/backend.hpp"
#include "technique/volume/parts.hpp"

namespace triptych::vulkan_backend {

// Cuts the volume into parts for the technique.
[[nodiscard]] technique::Cut cut_of(const Gpu& gpu, std::string_view technique,
                                    const measure::VolumeWork& work);

// Returns whether one image can hold the volume.
[[nodiscard]] bool can_store_whole(const Gpu& gpu, const std::array<int, 3>& size,
                                   scene::VoxelFormat format);

// Uploads the parts one after another to the resources that the shader reads.
class VolumeParts {
 public:
  // `parameters` (technique::raycast_parameters) must have room for a technique::PartParameters at
  // the end. `map` is the result of technique::brick_map.
  VolumeParts(const Gpu& gpu, const measure::VolumeWork& work,
              std::span<const technique::Part> parts, std::span<const std::int32_t> map,
              std::vector<std::byte> parameters);

  [[nodiscard]] int count() const noexcept { return static_cast<int>(passes_.size()); }
  // Uploads the parameters of the n-th part to `parameters` and, if the shader reads the part's
  // voxels, uploads the voxels to `image` or `cells`.
  void move(int n, const Buffer& parameters, const Image* image, const Buffer* cells);

 private:
  const Gpu& gpu_;
  std::shared_ptr<const scene::VoxelGrid> grid_;
  technique::Layers layers_;
  std::vector<technique::PartPass> passes_;
  std::vector<std::byte> parameters_;
  measure::MemoryLedger::Entry moved_;
};

}  // namespace triptych::vulkan_backend
