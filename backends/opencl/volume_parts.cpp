#include "backends/opencl/volume_parts.hpp"

#include "backends/opencl/volume_data.hpp"
#include "scene/volume.hpp"

namespace triptych::opencl_backend {

technique::Cut cut_of(const Session& session, std::string_view technique,
                      const measure::VolumeWork& work) {
  const scene::VoxelGrid& grid = *work.scene.grid;
  technique::MemoryLimit limit{
      .bytes = checked([&] { return session.device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(); }),
      .name = "CL_DEVICE_MAX_MEM_ALLOC_SIZE"};
  const std::uint64_t indexed = most_indices * scene::bytes_of(grid.format);
  if (work.options.sampler == technique::Sampler::manual && indexed < limit.bytes) {
    limit = {indexed, "the size of the largest buffer that the kernel can index"};
  }
  return technique::cut_into_parts(technique, work.scene, work.options, bordered_layers(grid),
                                   technique::within_budget(limit, work.options));
}

VolumeParts::VolumeParts(const Session& session, const measure::VolumeWork& work,
                         std::span<const technique::Part> parts, std::span<const std::int32_t> map,
                         const cl::Buffer& voxels, const cl::Buffer& parameters)
    : session_(session),
      grid_(work.scene.grid),
      passes_(technique::part_passes(parts, work.scene, work.options, map)),
      voxels_(voxels),
      parameters_(parameters),
      place_(parameters.getInfo<CL_MEM_SIZE>() - sizeof(technique::PartParameters)),
      moved_(
          session.memory_ledger.moved(technique::moved_bytes(passes_, bordered_layers(*grid_)))) {}

void VolumeParts::run(const Launch& launch, std::vector<cl::Event>& events) const {
  events.assign(1 + passes_.size(), {});
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    const technique::PartPass& pass = passes_[i];
    session_.queue.enqueueWriteBuffer(parameters_, CL_TRUE, place_, sizeof pass.parameters,
                                      &pass.parameters, nullptr,
                                      i == 0 ? &events.front() : nullptr);
    if (pass.read) {
      write_layers(session_, voxels_, *grid_, pass.part.first_stored, pass.part.stored_cells());
    }
    session_.queue.enqueueNDRangeKernel(launch.kernel, cl::NullRange, launch.global, launch.local,
                                        nullptr, &events[1 + i]);
  }
  session_.queue.finish();
}

}  // namespace triptych::opencl_backend
