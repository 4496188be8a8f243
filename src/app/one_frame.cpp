#include "app/one_frame.hpp"

#include "app/terminal.hpp"
#include "core/output_files.hpp"
#include "measure/worker/listing.hpp"

namespace triptych::app {

void FrameArguments::add_to(CLI::App& command) {
  command.add_option("SUITE", suite, "Suite: volume or particles")->required();
  command.add_option("--device", device, "Device id, or a glob that matches exactly one device");
  command.add_option("--set", set,
                     "factor=level: set this factor to this level (repeatable); write a comma "
                     "inside a level as %2C");
  add_inject_option(command, faults, "Inject a fault (repeatable); see `triptych run --help`");
}

ChosenData choose_data(const Registry& registry, const FrameArguments& arguments) {
  measure::SuiteWithTruth& suite = registry.suite(arguments.suite);
  measure::Plan plan = measure::default_plan(suite, PlanChoice{.set = arguments.set}.overrides());
  std::vector<std::string> several = plan.varied;
  if (arguments.allow_auto) {
    std::erase_if(several, [&](const auto& factor) { return plan.automatic.contains(factor); });
  }
  if (!several.empty()) {
    throw core::InputError(
        "this command draws a single configuration; set each factor to one level");
  }
  if (const std::string reason = suite.missing_data(plan.configurations.front()); !reason.empty()) {
    throw core::InputError(reason);
  }
  return {suite, std::move(plan)};
}

OneFrame choose_frame(const Registry& registry, const FrameArguments& arguments) {
  if (arguments.device.empty()) registry.refuse_missing_device();
  core::require_writable(arguments.out);
  auto [suite, plan] = choose_data(registry, arguments);
  return {
      suite, std::move(plan),
      measure::choose_device(registry.devices({arguments.device}), "--device", arguments.device)};
}

void print_device(const record::Device& device) {
  print_out("{}: {}, driver {}{}\n", device.id, device.name, device.driver_version,
            device.compiles_for.empty() ? "" : "; compiles code but cannot execute it");
}

}  // namespace triptych::app
