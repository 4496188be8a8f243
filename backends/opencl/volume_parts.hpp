#pragma once
// A volume that is on the device one part at a time (technique/volume/parts.hpp).

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "backends/opencl/launches.hpp"
#include "backends/opencl/objects.hpp"
#include "measure/contract/backend.hpp"
#include "technique/volume/parts.hpp"

namespace triptych::opencl_backend {

// Kernels index voxels and counters by signed 32-bit numbers.
inline constexpr std::uint64_t most_indices = std::numeric_limits<std::int32_t>::max();

[[nodiscard]] technique::Cut cut_of(const Session& session, std::string_view technique,
                                    const measure::VolumeWork& work);

// The passes of a frame, each after the voxels and parameters that it reads.
class VolumeParts {
 public:
  // `map` is the result of technique::brick_map. `parameters` must have room for
  // technique::PartParameters at the end.
  VolumeParts(const Session& session, const measure::VolumeWork& work,
              std::span<const technique::Part> parts, std::span<const std::int32_t> map,
              const cl::Buffer& voxels, const cl::Buffer& parameters);

  // Like opencl_backend::run with one launch. `events` gets those of the frame's first command and
  // of each launch.
  void run(const Launch& launch, std::vector<cl::Event>& events) const;

 private:
  Session session_;
  std::shared_ptr<const scene::VoxelGrid> grid_;
  std::vector<technique::PartPass> passes_;
  cl::Buffer voxels_;
  cl::Buffer parameters_;
  std::size_t place_;  // the offset of a part's parameters within the parameters
  measure::MemoryLedger::Entry moved_;
};

}  // namespace triptych::opencl_backend
