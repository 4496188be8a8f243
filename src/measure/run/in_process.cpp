#include "measure/run/in_process.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"
#include "measure/protocol/frame_proof.hpp"
#include "measure/protocol/protocol.hpp"
#include "measure/run/sprite_draws.hpp"
#include "measure/system/frame_capture.hpp"
#include "measure/worker/worker.hpp"

namespace triptych::measure {
namespace {

void require_inside(const core::Image& image, PixelPlace place) {
  if (place.x >= image.width || place.y >= image.height) {
    throw core::InputError(fmt::format("--pixel {},{} is outside the image, which has {}x{} pixels",
                                       place.x, place.y, image.width, image.height));
  }
}

TracedPixel trace_pixel(Prepared& prepared, PixelPlace place) {
  auto* const tracer = dynamic_cast<PixelTracer*>(&prepared);
  if (tracer == nullptr) throw core::NotSupported(pixel_history_of_device_unsupported);
  prepared.poison();
  technique::RayTrace trace = tracer->trace(place.x, place.y);
  return {.place = place, .trace = std::move(trace), .image = prepared.image(), .sprites = {}};
}

}  // namespace

FrameInProcess draw_in_process(const Backend& backend, std::string_view device_id, Suite& suite,
                               const Plan& plan, std::span<const InjectedFault> faults,
                               const std::string& capture, std::optional<PixelPlace> pixel) {
  Configuration configuration = plan.configurations.front();
  const std::string key = configuration_key(suite, configuration);
  const std::string scene = scene_key(suite, configuration);
  const auto device = backend.open(device_id);
  Work work = suite.work(configuration, *device);
  for (const std::string& fault : faults_for(faults, key, device->info().id)) inject(fault, work);
  if (const auto reason = device->unsupported(work)) throw core::NotSupported(*reason);
  const auto prepared = device->prepare(work);
  FrameProof proof(*prepared);
  proof.start();
  {
    const FrameCapture captured(capture);
    static_cast<void>(prepared->frame(Purpose::timing));
  }
  proof.check_drawn("the frame");
  FrameInProcess drawn{.record = {},
                       .image = proof.take_image(),
                       .device = device->info(),
                       .not_drawn = proof.pixels_not_drawn(),
                       .traced = {}};
  record::Record& record = drawn.record;
  describe_work(work, *device, record);
  if (pixel) {
    require_inside(drawn.image, *pixel);
    if (std::holds_alternative<VolumeWork>(work.scene)) {
      drawn.traced = trace_pixel(*prepared, *pixel);
    } else {
      drawn.traced = TracedPixel{.place = *pixel, .trace = {}, .image = {}, .sprites = {}};
      drawn.traced->sprites = sprite_history(
          *device, work, suite, {.configuration = configuration, .precision = record.precision},
          *pixel, shown_at(drawn.image, *pixel));
    }
  }
  record.suite = plan.suite;
  record.plan = plan.name;
  record.configuration = key;
  record.scene = scene;
  record.technique = work.technique;
  record.device = drawn.device.id;
  record.factors = std::move(configuration);
  record.outcome = record::Outcome::measured;
  record.kernel_hash = prepared->kernel_hash();
  record.image = image_hash(drawn.image);
  return drawn;
}

}  // namespace triptych::measure
