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
  if (const auto reason = forbids_measuring()) throw core::InputError(*reason);
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
  const Done done = device_.perform(configuration, key, {});
  if (const auto signal = interrupts_.take()) throw Interrupted(*signal);
  if (!done.exr.empty()) store_.add_image(done.record.image, done.exr);
  store_.add_record(done.record);
  return done.record;
}

record::Device SingleFrames::device() const {
  for (const auto& entry : store_.devices(context_.run)) return entry.device;
  throw core::InputError("the device was never opened");
}

}  // namespace triptych::measure
