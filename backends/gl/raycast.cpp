// Traces one ray per invocation of a compute shader.
#include "backends/gl/compute_pass.hpp"
#include "backends/gl/techniques.hpp"
#include "backends/gl/volume_parts.hpp"
#include "backends/gl/volume_prepared.hpp"

namespace triptych::gl_backend {
namespace {

std::optional<std::string> raycast_unsupported(const Api& gl, const measure::VolumeWork& work) {
  return ComputePass::unsupported(gl, work.scene.width, work.scene.height);
}

std::unique_ptr<measure::Prepared> prepare_raycast(Context& context, Stamps stamps,
                                                   const measure::VolumeWork& work) {
  Constants constants = constants_of(work);
  constants.parts = !cut_of(context.gl(), "raycast", work).parts.empty();
  return prepare_volume(
      context, stamps, work, constants,
      std::make_unique<ComputePass>(context.gl(), work.scene.width, work.scene.height,
                                    work.options.extra_work_stride));
}

}  // namespace

VolumeTechnique raycast() {
  return {&raycast_unsupported, &prepare_raycast};
}

}  // namespace triptych::gl_backend
