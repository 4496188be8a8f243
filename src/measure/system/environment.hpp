#pragma once
// The environment variables of drivers: defaults that they need to work well in a worker process,
// variables that must not reach a worker, and variables that must not be set while measuring.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/private_folder.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {

// A variable that workers get unless the user has set it.
struct EnvironmentDefault {
  std::string_view name;
  std::string_view value;  // "{cache}" stands for the worker's own cache folder
  std::string_view api;    // prefix of the ids of the devices that get it
  std::string_view reason;
};
[[nodiscard]] std::span<const EnvironmentDefault> environment_defaults();

// A cache folder that belongs to one worker at a time. It is kept from run to run, so that drivers
// find what they compiled before: $XDG_CACHE_HOME/triptych (or ~/.cache/triptych, or the folder for
// temporary files) /<device>-<n>, where n is the first number that no other worker uses. The folder
// is reserved until this object is destroyed, even if the worker is replaced. Drivers load compiled
// code from it, so only folders that belong to this user alone are used (core/private_folder.hpp).
class CacheFolder {
 public:
  // Throws IoError with the reason if no such folder can be used anywhere.
  explicit CacheFolder(std::string_view device_id);
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  FileDescriptor lock_;
};

// The folder with that name next to those of the workers, in the first of these places that can be
// used. Throws IoError as CacheFolder does.
[[nodiscard]] core::PrivateFolder cache_folder(const std::string& name);

// The complete environment of a worker for this device, as "NAME=VALUE": the caller's own without
// variables that change how benchmarks are run (BENCHMARK_*), with the defaults that are missing.
// `overrides` ("NAME=VALUE") replace both; "{cache}" in a value stands for the folder.
[[nodiscard]] std::vector<std::string> worker_environment(
    std::string_view device_id, const CacheFolder& cache,
    std::span<const std::string> overrides = {});

// Splits "NAME=VALUE,…". A value may contain commas that are not followed by NAME=. Throws
// core::InputError with a message that begins with `where`.
[[nodiscard]] std::vector<std::string> parse_environment(std::string_view text,
                                                         const std::string& where);

// The reason why nothing may be measured with the environment variables of this process; nullopt if
// there is none. (LP_PERF makes llvmpipe skip work, so that times and images would be wrong.)
[[nodiscard]] std::optional<std::string> forbids_measuring();
// The same for the environment of a worker, as "NAME=VALUE".
[[nodiscard]] std::optional<std::string> forbids_measuring(
    std::span<const std::string> environment);

}  // namespace triptych::measure
