#pragma once
// Environment variables for drivers: defaults that make drivers work well in a worker process,
// variables that are not passed on to a worker, and variables that must not be set while measuring.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/private_folder.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {

// A cache folder for a single worker. It remains after the run, so that later runs find the code
// that was compiled before. Its path is ROOT/<device>-<n>. ROOT is $XDG_CACHE_HOME/triptych,
// ~/.cache/triptych or a folder in the system's folder for temporary files, and n is the first
// number that no other worker uses. The folder is reserved until this object is destroyed, even if
// the worker is replaced. Because drivers load compiled code from the folder, only this user may
// have access to it (core/private_folder.hpp).
class CacheFolder {
 public:
  // Throws an IoError that states the reasons if none of these folders can be used.
  explicit CacheFolder(std::string_view device_id);
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  FileDescriptor lock_;
};

// Returns a folder with this name, in the same place as the cache folders of the workers. Throws
// IoError in the same cases as CacheFolder.
[[nodiscard]] core::PrivateFolder cache_folder(const std::string& name);

// Returns the complete environment of a worker for this device, as "NAME=VALUE". It contains the
// variables of this process, except those that configure Google Benchmark (BENCHMARK_*), and the
// defaults for variables that are not set. The variables in `overrides` ("NAME=VALUE") take
// precedence over both. "{cache}" in a value stands for the path of the cache folder.
[[nodiscard]] std::vector<std::string> worker_environment(
    std::string_view device_id, const CacheFolder& cache,
    std::span<const std::string> overrides = {});

// Splits "NAME=VALUE,…". A value may contain commas that are not followed by NAME=. Throws
// core::InputError with a message that begins with `where`.
[[nodiscard]] std::vector<std::string> parse_environment(std::string_view text,
                                                         const std::string& where);

// Returns the names of the variables that select a driver, such as VK_DRIVER_FILES, and whose
// values differ between two workers. Each argument contains the variables ("NAME=VALUE") that are
// set for one of the workers. A worker inherits all other variables from this process.
[[nodiscard]] std::vector<std::string> differing_driver_variables(std::span<const std::string> a,
                                                                  std::span<const std::string> b);

// Returns the reason why the environment variables of this process make measuring impossible, or
// nullopt if there is no such reason. For example, LP_PERF makes llvmpipe skip work, so that times
// and images would be wrong.
[[nodiscard]] std::optional<std::string> reason_not_to_measure();
// Like the overload above, but for a worker whose environment is given as "NAME=VALUE" strings.
[[nodiscard]] std::optional<std::string> reason_not_to_measure(
    std::span<const std::string> environment);

}  // namespace triptych::measure
