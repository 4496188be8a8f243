#pragma once
// A volume of which the device stores only one part at a time (technique/volume/parts.hpp).

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "backends/gl/objects.hpp"
#include "measure/contract/backend.hpp"
#include "technique/volume/parts.hpp"

namespace triptych::gl_backend {

// Cuts the volume into parts for the technique.
[[nodiscard]] technique::Cut cut_of(const Api& gl, std::string_view technique,
                                    const measure::VolumeWork& work);

// Returns whether one texture can hold the volume.
[[nodiscard]] bool can_store_whole(const Api& gl, const std::array<int, 3>& size,
                                   scene::VoxelFormat format);

// Uploads the parts one after another to the resources that the shader reads.
class VolumeParts {
 public:
  // `map` is the result of technique::brick_map.
  VolumeParts(const Api& gl, const measure::VolumeWork& work,
              const std::vector<technique::Part>& parts, std::span<const std::int32_t> map);

  [[nodiscard]] int count() const noexcept { return static_cast<int>(passes_.size()); }
  // Uploads the n-th part: writes its parameters to the end of `parameters` and, if the shader
  // reads its voxels, uploads the voxels to the bound texture or to `cells`.
  void move(const Api& gl, int n, const Buffer& parameters, const Buffer* cells) const;

 private:
  void fill_cells(const Api& gl, const technique::Part& part, const Buffer& cells) const;

  std::shared_ptr<const scene::VoxelGrid> grid_;
  technique::Layers layers_;
  std::vector<technique::PartPass> passes_;
  std::size_t place_;  // the offset of a part's parameters in the parameter buffer
  measure::MemoryLedger::Entry moved_;
};

}  // namespace triptych::gl_backend
