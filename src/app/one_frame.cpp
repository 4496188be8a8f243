#include "app/one_frame.hpp"

#include <fmt/format.h>

#include <system_error>

#include "app/listing.hpp"
#include "app/paths.hpp"
#include "record/bad_input.hpp"

namespace triptych::app {

void FrameArguments::add_to(CLI::App& command) {
  command.add_option("SUITE", suite, "volume or particles")->required();
  command.add_option("--device", device, "Device id or a glob for one")->required();
  command.add_option("--set", set, "factor=value (repeatable); a comma in it is spelled %2C");
  add_inject_option(command, faults, "Inject a fault, as for run (repeatable)");
}

OneFrame choose_frame(const Registry& registry, const FrameArguments& arguments) {
  measure::SuiteWithTruth& suite = registry.suite(arguments.suite);
  measure::Plan plan = measure::default_plan(suite, parse_overrides(arguments.set));
  std::vector<std::string> several = plan.varied;
  if (arguments.chooses) {
    std::erase_if(several, [&](const auto& factor) { return plan.automatic.contains(factor); });
  }
  if (!several.empty()) {
    throw core::InputError("one configuration is drawn: give each factor one value");
  }
  require_writable(arguments.out);
  if (const std::string reason = suite.missing_data(plan.configurations.front()); !reason.empty()) {
    throw core::InputError(reason);
  }
  return {suite, std::move(plan), choose_device(registry, "--device", arguments.device)};
}

void require_drawable(const record::Record& record) {
  if (record.outcome != record::Outcome::skipped) return;
  if (record::has_bad_input(record)) throw core::InputError(record.reason);
  throw core::NotSupported(record.reason);
}

void ScratchFile::remove() const {
  std::error_code ignored;
  for (const char* suffix : {"", "-wal", "-shm"}) {
    std::filesystem::remove(path_.string() + suffix, ignored);
  }
}

}  // namespace triptych::app
