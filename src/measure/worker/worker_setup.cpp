#include "measure/worker/worker_setup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <variant>

#include "core/hash.hpp"
#include "measure/counting/emulator.hpp"
#include "measure/system/compile_only.hpp"

namespace triptych::measure {
namespace {

// Sets a separate shader cache for Mesa. The default cache is shared by all programs, so a worker
// with additional environment variables must not use it.
void separate_shader_caches(std::vector<std::string>& environment) {
  constexpr const char* name = "MESA_SHADER_CACHE_DIR";
  const auto sets_it = [&](const std::string& entry) {
    return entry.starts_with(fmt::format("{}=", name));
  };
  if (std::getenv(name) != nullptr || std::ranges::any_of(environment, sets_it)) return;
  environment.push_back(fmt::format("{}={{cache}}/mesa", name));
}

// Sets a variable ("NAME=VALUE"). The variables of a device that only compiles replace those of the
// user, because they were derived from them: VK_DRIVER_FILES, for example, becomes the driver of
// that device in the folder that the user's VK_DRIVER_FILES names.
void replace_variable(std::string entry, std::vector<std::string>& environment) {
  const std::string name = entry.substr(0, entry.find('=') + 1);
  std::erase_if(environment, [&](const std::string& each) { return each.starts_with(name); });
  environment.push_back(std::move(entry));
}

// Returns the variables that override the environment of a worker whose instructions are counted,
// and of the worker that fills its cache folder with compiled code (ahead_setup()).
std::vector<std::string> counted_overrides(const SideOptions& side) {
  std::vector<std::string> overrides = side.environment;
  for (const std::string_view each : counting_environment()) overrides.emplace_back(each);
  return overrides;
}

}  // namespace

std::string cache_name(const SideOptions& side, bool counted) {
  std::string name = side.device + (counted ? "-counted" : "");
  if (side.environment.empty()) return name;
  const std::string variables = fmt::format("{}", fmt::join(side.environment, " "));
  return fmt::format("{}-{}", name, core::content_hash(variables).substr(0, 8));
}

WorkerSetup worker_setup(const SideOptions& side, bool counted, const CacheFolder& cache,
                         std::chrono::milliseconds limit) {
  WorkerSetup setup{.device = side.device,
                    .command = side.command,
                    .environment = {},
                    .limit = counted ? counted_limit : limit};
  std::vector<std::string> overrides = counted ? counted_overrides(side) : side.environment;
  if (counted) {
    if (const auto* emulator = std::get_if<Emulator>(&find_emulator())) {
      setup.command = emulated(*emulator, std::move(setup.command), cache.path().string());
      overrides.insert(overrides.end(), emulator->environment.begin(), emulator->environment.end());
    }
  } else if (!side.environment.empty()) {
    separate_shader_caches(overrides);
  }
  if (!counted) {
    for (std::string& each : compile_only_environment(side.device, side.environment)) {
      replace_variable(std::move(each), overrides);
    }
  }
  setup.environment = worker_environment(side.device, cache, overrides);
  return setup;
}

std::optional<WorkerSetup> ahead_setup(const SideOptions& side, const CacheFolder& cache,
                                       std::chrono::milliseconds limit) {
  const auto compiling = compiles_for_emulator(side.device);
  if (!compiling || !std::holds_alternative<Emulator>(find_emulator())) return std::nullopt;
  std::vector<std::string> overrides = counted_overrides(side);
  overrides.insert(overrides.end(), compiling->begin(), compiling->end());
  return WorkerSetup{.device = side.device,
                     .command = side.command,
                     .environment = worker_environment(side.device, cache, overrides),
                     .limit = limit};
}

}  // namespace triptych::measure
