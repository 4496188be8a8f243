#pragma once
// A volume of which the device stores only one part at a time (technique/volume/parts.hpp).

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

// Kernels index voxels and counters with signed 32-bit integers.
inline constexpr std::uint64_t most_indices = std::numeric_limits<std::int32_t>::max();

[[nodiscard]] technique::Cut cut_of(const Session& session, std::string_view technique,
                                    const measure::VolumeWork& work);

// The passes of a frame. Before each pass, the voxels and parameters that it reads are uploaded.
class VolumeParts {
 public:
  // `map` is the result of technique::brick_map. `parameters` must have room for a
  // technique::PartParameters at the end.
  VolumeParts(const Session& session, const measure::VolumeWork& work,
              std::span<const technique::Part> parts, std::span<const std::int32_t> map,
              const cl::Buffer& voxels, const cl::Buffer& parameters);

  // Runs the launch once per part, and waits until all commands have finished. Fills `events` with
  // the event of the frame's first command and the events of the launches.
  void run(const Launch& launch, std::vector<cl::Event>& events) const;

 private:
  Session session_;
  std::shared_ptr<const scene::VoxelGrid> grid_;
  std::vector<technique::PartPass> passes_;
  cl::Buffer voxels_;
  cl::Buffer parameters_;
  std::size_t place_;  // the offset of a part's parameters in the parameter buffer
  measure::MemoryLedger::Entry moved_;
};

}  // namespace triptych::opencl_backend
