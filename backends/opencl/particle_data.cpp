#include "backends/opencl/particle_data.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "backends/opencl/launches.hpp"
#include "technique/particles/arrangement.hpp"
#include "technique/particles/particle_parameters.hpp"

namespace triptych::opencl_backend {
namespace {

// Uploads through a small staging array, because a driver may copy the whole buffer when it is
// mapped as a whole.
cl::Buffer upload_property(const Session& session, const technique::Arrangement& arrangement,
                           technique::Property property) {
  constexpr std::size_t smallest = 16;  // OpenCL does not allow empty buffers
  // a multiple of the element size of every property
  constexpr std::size_t most_at_once = std::size_t{4} << 20U;
  const std::size_t size = arrangement.bytes(property);
  const cl::Buffer buffer = make_buffer(session, CL_MEM_READ_ONLY, std::max(size, smallest));
  std::vector<std::byte> memory(std::min(size, most_at_once));
  for (std::size_t begin = 0; begin < size; begin += memory.size()) {
    const std::span piece = std::span(memory).first(std::min(memory.size(), size - begin));
    arrangement.copy(property, begin, piece);
    write_buffer(session, buffer, begin, piece.size(), piece.data());
  }
  return buffer;
}

}  // namespace

void upload_camera(const Session& session, const ParticleData& data,
                   const measure::ParticleWork& work) {
  const technique::ParticleParameters parameters =
      technique::particle_parameters(work.scene, work.options, data.count, data.cell_count);
  write_buffer(session, data.parameters, 0, sizeof parameters, &parameters);
}

ParticleData upload(const Session& session, const measure::ParticleWork& work) {
  const technique::Arrangement arrangement = technique::arrange(work.scene);
  const technique::ParticleParameters parameters =
      technique::particle_parameters(work.scene, work.options, arrangement);
  return checked([&] {
    ParticleData data{.count = arrangement.count(), .cell_count = arrangement.cells.size()};
    data.parameters = upload_bytes(session, std::as_bytes(std::span(&parameters, 1)));
    data.spheres = upload_property(session, arrangement, technique::Property::sphere);
    data.colours = upload_property(session, arrangement, technique::Property::colour);
    data.ids = upload_property(session, arrangement, technique::Property::id);
    data.cells = upload_bytes(session, std::as_bytes(std::span(arrangement.cells)));
    data.table =
        upload_bytes(session, std::as_bytes(std::span(work.scene.intensity_colours.entries)));
    return data;
  });
}

}  // namespace triptych::opencl_backend
