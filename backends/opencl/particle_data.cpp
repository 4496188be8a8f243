#include "backends/opencl/particle_data.hpp"

#include <span>
#include <utility>
#include <vector>

#include "backends/opencl/launches.hpp"
#include "technique/particles/arrangement.hpp"
#include "technique/particles/particle_parameters.hpp"

namespace triptych::opencl_backend {
namespace {

// Leaves nothing in `values`: of 10 million particles every array counts.
template <typename Value>
cl::Buffer move_to_device(const Session& session, std::vector<Value>& values) {
  const std::vector<Value> moved = std::exchange(values, {});
  return upload_bytes(session, std::as_bytes(std::span(moved)));
}

cl::Buffer move_colours(const Session& session, technique::Arrangement& arrangement) {
  switch (arrangement.colour) {
    case scene::ColourKind::rgba8:
      return move_to_device(session, arrangement.rgba8);
    case scene::ColourKind::rgba32:
      return move_to_device(session, arrangement.rgba32);
    case scene::ColourKind::intensity:
      return move_to_device(session, arrangement.intensity);
  }
  return {};
}

}  // namespace

ParticleData upload(const Session& session, const measure::ParticleWork& work) {
  technique::Arrangement arrangement = technique::arrange(work.scene);
  const technique::ParticleParameters parameters =
      technique::particle_parameters(work.scene, work.options, arrangement);
  return checked([&] {
    ParticleData data{.count = arrangement.count(), .cell_count = arrangement.cells.size()};
    data.parameters = upload_bytes(session, std::as_bytes(std::span(&parameters, 1)));
    data.spheres = move_to_device(session, arrangement.spheres);
    data.colours = move_colours(session, arrangement);
    data.ids = move_to_device(session, arrangement.ids);
    data.cells = move_to_device(session, arrangement.cells);
    data.table =
        upload_bytes(session, std::as_bytes(std::span(work.scene.intensity_colours.entries)));
    return data;
  });
}

}  // namespace triptych::opencl_backend
