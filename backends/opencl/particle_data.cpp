#include "backends/opencl/particle_data.hpp"

#include <span>

#include "backends/opencl/launches.hpp"
#include "technique/particles/arrangement.hpp"
#include "technique/particles/particle_parameters.hpp"

namespace triptych::opencl_backend {
namespace {

cl::Buffer upload_colours(const Session& session, const technique::Arrangement& arrangement) {
  switch (arrangement.colour) {
    case scene::ColourKind::rgba8:
      return upload_bytes(session, std::as_bytes(std::span(arrangement.rgba8)));
    case scene::ColourKind::rgba32:
      return upload_bytes(session, std::as_bytes(std::span(arrangement.rgba32)));
    case scene::ColourKind::intensity:
      return upload_bytes(session, std::as_bytes(std::span(arrangement.intensity)));
  }
  return {};
}

}  // namespace

ParticleData upload(const Session& session, const measure::ParticleWork& work) {
  const technique::Arrangement arrangement = technique::arrange(work.scene);
  const technique::ParticleParameters parameters =
      technique::particle_parameters(work.scene, work.options, arrangement);
  const auto to_device = [&](const auto& values) {
    return upload_bytes(session, std::as_bytes(std::span(values)));
  };
  return checked([&] {
    return ParticleData{
        .count = arrangement.count(),
        .cell_count = arrangement.cells.size(),
        .parameters = upload_bytes(session, std::as_bytes(std::span(&parameters, 1))),
        .spheres = to_device(arrangement.spheres),
        .colours = upload_colours(session, arrangement),
        .ids = to_device(arrangement.ids),
        .cells = to_device(arrangement.cells),
        .table = to_device(work.scene.intensity_colours.entries)};
  });
}

}  // namespace triptych::opencl_backend
