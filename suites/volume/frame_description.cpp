#include "suites/volume/frame_description.hpp"

#include "core/json.hpp"
#include "measure/contract/factor.hpp"

namespace triptych::volume_suite {
namespace {

using core::Json;

Json shading_json(const scene::Shading& shading) {
  if (!shading.enabled) return {{"model", "none"}};
  return {{"model", "headlight"},         {"ambient", shading.ambient},
          {"diffuse", shading.diffuse},   {"specular", shading.specular},
          {"exponent", shading.exponent}, {"gradient_floor", shading.gradient_floor}};
}

}  // namespace

Json describe_frame(const scene::VolumeScene& scene, double ert, double adapt) {
  const scene::VoxelGrid& grid = *scene.grid;
  Json frame{{"viewport", {scene.width, scene.height}},
             {"camera", measure::camera_json(scene.camera)},
             {"volume",
              {{"size", grid.size},
               {"spacing", grid.spacing},
               {"range", {grid.range_lo, grid.range_hi}},
               {"step_voxels", scene.step_voxels},
               {"quadrature", scene::name_of(scene.quadrature)},
               {"transfer_function", scene.transfer_function.entries},
               {"background", scene.background},
               {"ert", ert},
               {"shading", shading_json(scene.shading)}}}};
  if (grid.mapping != scene::Mapping::linear) {
    frame["volume"]["mapping"] = scene::name_of(grid.mapping);
  }
  if (adapt > 0) frame["volume"]["adapt"] = adapt;
  return frame;
}

}  // namespace triptych::volume_suite
