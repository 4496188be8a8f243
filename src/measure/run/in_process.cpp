#include "measure/run/in_process.hpp"

#include <utility>

#include "core/error.hpp"
#include "measure/protocol/protocol.hpp"
#include "measure/system/frame_capture.hpp"
#include "measure/worker/worker.hpp"

namespace triptych::measure {

FrameInProcess draw_in_process(const Backend& backend, std::string_view device_id, Suite& suite,
                               const Plan& plan, std::span<const InjectedFault> faults,
                               const std::string& capture) {
  Configuration configuration = plan.configurations.front();
  const std::string key = configuration_key(suite, configuration);
  const std::string scene = scene_key(suite, configuration);
  const auto device = backend.open(device_id);
  Work work = suite.work(configuration, *device);
  for (const std::string& fault : faults_for(faults, key, device->info().id)) inject(fault, work);
  if (const auto reason = device->unsupported(work)) throw core::NotSupported(*reason);
  const auto prepared = device->prepare(work);
  {
    const FrameCapture captured(capture);
    static_cast<void>(prepared->frame(Purpose::timing));
  }
  FrameInProcess drawn{.record = {}, .image = prepared->image(), .device = device->info()};
  record::Record& record = drawn.record;
  describe_work(work, *device, record);
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
