#include "measure/run/new_run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <random>
#include <utility>

#include "measure/system/system_facts.hpp"

namespace triptych::measure {
namespace {

std::string utc_now(const char* format) {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format(fmt::runtime(fmt::format("{{:{}}}", format)), fmt::gmtime(now));
}

}  // namespace

record::Run new_run(const Plan& plan, const std::string& program) {
  std::random_device entropy;
  std::map<std::string, std::string> system = system_facts();
  if (!program.empty()) system["triptych"] = program;
  return {.id = fmt::format("{}-{:08x}", utc_now("%Y%m%dT%H%M%SZ"), entropy()),
          .plan = plan.name,
          .started_at = utc_now("%Y-%m-%dT%H:%M:%SZ"),
          .system = std::move(system),
          .checks = plan.checks,
          .plan_hash = plan.hash,
          .configurations = plan.configurations.size()};
}

}  // namespace triptych::measure
