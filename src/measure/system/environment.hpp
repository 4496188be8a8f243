#pragma once
// The environment that drivers are run in: defaults that they need to work well in a worker
// process, what must not reach one, and what forbids measuring.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/private_folder.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {

// A variable given to workers unless the user has set it.
struct EnvironmentDefault {
  std::string_view name;
  std::string_view value;  // "{cache}" stands for the worker's own cache folder
  std::string_view api;    // prefix of the device ids concerned
  std::string_view reason;
};
[[nodiscard]] std::span<const EnvironmentDefault> environment_defaults();

// A cache folder that belongs to one worker at a time, kept from run to run so that drivers find
// what they compiled before: $XDG_CACHE_HOME/triptych (or ~/.cache/triptych, or the folder for
// temporary files) /<device>-<n>, n the first that nobody else holds. Held until destroyed, across
// the worker's replacements. Drivers load compiled code from it: only folders that are this user's
// alone are used (core/private_folder.hpp).
class CacheFolder {
 public:
  // Throws IoError that says why when no such folder can be used anywhere.
  explicit CacheFolder(std::string_view device_id);
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  FileDescriptor lock_;
};

// The folder of that name beside those of the workers, where the first of these places is usable.
// Throws IoError as CacheFolder does.
[[nodiscard]] core::PrivateFolder cache_folder(const std::string& name);

// The whole environment of a worker for this device, "NAME=VALUE" each: the caller's own without
// what would change how benchmarks are run (BENCHMARK_*), with the defaults it lacks. `overrides`,
// "NAME=VALUE" each, win over both; "{cache}" in one stands for the folder.
[[nodiscard]] std::vector<std::string> worker_environment(
    std::string_view device_id, const CacheFolder& cache,
    std::span<const std::string> overrides = {});

// "NAME=VALUE,…" → each; a value may hold commas that no NAME= follows. Throws core::InputError
// that begins with `where`.
[[nodiscard]] std::vector<std::string> parse_environment(std::string_view text,
                                                         const std::string& where);

// Why nothing may be measured in this process's environment; nullopt: it may. (LP_PERF turns off
// parts of llvmpipe's work: what is timed would not be what is drawn.)
[[nodiscard]] std::optional<std::string> forbids_measuring();
// The same of a worker's environment, "NAME=VALUE" each.
[[nodiscard]] std::optional<std::string> forbids_measuring(
    std::span<const std::string> environment);

}  // namespace triptych::measure
