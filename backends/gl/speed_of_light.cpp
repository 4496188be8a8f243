// Performs only the fetches and table look-ups of raycast. Runs the same pass as raycast, with a
// compile-time constant that removes all other work.
#include "backends/gl/compute_pass.hpp"
#include "backends/gl/techniques.hpp"
#include "backends/gl/volume_prepared.hpp"

namespace triptych::gl_backend {
namespace {

std::optional<std::string> speed_of_light_unsupported(const Api& gl,
                                                      const measure::VolumeWork& work) {
  return ComputePass::unsupported(gl, work.scene.width, work.scene.height);
}

std::unique_ptr<measure::Prepared> prepare_speed_of_light(Context& context, Stamps stamps,
                                                          const measure::VolumeWork& work) {
  Constants constants = constants_of(work);
  constants.speed_of_light = true;
  return prepare_volume(
      context, stamps, work, constants,
      std::make_unique<ComputePass>(context.gl(), work.scene.width, work.scene.height,
                                    work.options.extra_work_stride));
}

}  // namespace

VolumeTechnique speed_of_light() {
  return {&speed_of_light_unsupported, &prepare_speed_of_light};
}

}  // namespace triptych::gl_backend
