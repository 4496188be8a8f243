#include "measure/run/single_frames.hpp"

#include <utility>

#include "core/error.hpp"
#include "measure/run/new_run.hpp"

namespace triptych::measure {
namespace {

Plan plan_for(const Suite& suite) {
  Plan plan;
  plan.name = std::string(suite.name());
  plan.suite = plan.name;
  plan.checks = {record::Check::image, record::Check::counters};
  return plan;
}

RunOptions untimed(RunOptions options) {
  if (const auto reason = reason_not_to_measure()) throw core::InputError(*reason);
  for (const InjectedFault& each : options.faults) check_fault(each.fault);
  options.protocol.timed = false;
  options.protocol.statistics = false;
  return options;
}

std::string begin(const Plan& plan, const RunOptions& options, record::Store& store) {
  const record::Run run = new_run(plan, options.program);
  store.add_run(run);
  return run.id;
}

}  // namespace

SingleFrames::SingleFrames(const Suite& suite, std::string device, record::Store& store,
                           const RunOptions& options, InterruptGuard& interrupts)
    : suite_(suite),
      store_(store),
      interrupts_(interrupts),
      options_(untimed(options)),
      plan_(plan_for(suite)),
      context_{plan_, suite_, store_, options_, interrupts_, begin(plan_, options_, store_), {}},
      device_(context_, std::move(device)) {}

record::Record SingleFrames::draw(const Configuration& configuration) {
  const std::string key = configuration_key(suite_, configuration);
  const ConfigurationResult result = device_.measure(configuration, key, {});
  if (const auto signal = interrupts_.received_signal()) throw Interrupted(*signal);
  if (!result.exr.empty()) store_.add_image(result.record.image, result.exr);
  store_.add_record(result.record);
  return result.record;
}

record::Device SingleFrames::device() const {
  for (const auto& entry : store_.devices(context_.run)) return entry.device;
  throw core::InputError("the device was never opened");
}

}  // namespace triptych::measure
