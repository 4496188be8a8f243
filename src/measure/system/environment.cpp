#include "measure/system/environment.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/private_folder.hpp"
#include "record/driver_variables.hpp"

namespace triptych::measure {
namespace {

// A variable that is set for workers unless the user has set it.
struct EnvironmentDefault {
  std::string_view name;
  std::string_view value;  // "{cache}" stands for the worker's own cache folder
  std::string_view api;    // prefix of the ids of the affected devices
};
constexpr std::array<EnvironmentDefault, 2> defaults{{
    // PoCL processes crash if they use the same kernel cache at the same time.
    {"POCL_CACHE_DIR", "{cache}", "opencl:"},
    // Otherwise PoCL uses only one thread for a launch with few work-groups, which halves the speed
    // for an image of 256x256 pixels.
    {"POCL_PTHREAD_MIN_WGS", "1", "opencl:"},
}};

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

// A folder for caches, and the name of Triptych's folder in it.
struct CachePlace {
  std::filesystem::path root;
  std::string name;
};

std::vector<CachePlace> cache_places() {
  std::vector<CachePlace> places;
  if (const std::string xdg = variable("XDG_CACHE_HOME"); !xdg.empty()) {
    places.push_back({xdg, "triptych"});
  }
  if (const std::string home = variable("HOME"); !home.empty()) {
    places.push_back({std::filesystem::path(home) / ".cache", "triptych"});
  }
  // The name contains the user id, because all users share the folder for temporary files.
  std::error_code error;
  const auto temporary = std::filesystem::temp_directory_path(error);
  if (!error) places.push_back({temporary, core::name_of_this_user()});
  return places;
}

std::string as_file_name(std::string_view device_id) {
  std::string name(device_id);
  for (char& letter : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
    if (!plain && letter != '.' && letter != '-' && letter != '_') letter = '-';
  }
  return name;
}

// Locks the folder's lock file and returns its descriptor. The descriptor is empty if another
// process holds the lock.
FileDescriptor try_lock(const core::PrivateFolder& folder) {
  FileDescriptor lock(
      ::openat(folder.fd(), "lock", O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600));
  if (!lock) {
    throw core::IoError(fmt::format("{}: {}", (folder.path() / "lock").string(),
                                    std::generic_category().message(errno)));
  }
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0) lock.reset();
  return lock;
}

std::string with_cache(std::string entry, const CacheFolder& cache) {
  constexpr std::string_view place = "{cache}";
  if (const std::size_t at = entry.find(place); at != std::string::npos) {
    entry.replace(at, place.size(), cache.path().string());
  }
  return entry;
}

std::string_view variable_name(std::string_view entry) {
  return entry.substr(0, entry.find('='));
}

// Returns whether the text begins with NAME=, which means that a comma before it ends the previous
// value.
bool starts_with_variable(std::string_view text) {
  const auto letter = [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
  };
  if (text.empty() || !letter(text.front())) return false;
  const auto* end = std::ranges::find_if_not(
      text, [&](char c) { return letter(c) || std::isdigit(static_cast<unsigned char>(c)); });
  return end != text.end() && *end == '=';
}

}  // namespace

CacheFolder::CacheFolder(std::string_view device_id) {
  constexpr int most_folders = 64;
  std::string reasons;
  for (const auto& [root, name] : cache_places()) {
    try {
      for (int n = 0; n < most_folders; ++n) {
        const std::array names{name, fmt::format("{}-{}", as_file_name(device_id), n)};
        const core::PrivateFolder folder(root, names);
        path_ = folder.path();
        lock_ = try_lock(folder);
        if (lock_) return;
      }
      reasons += fmt::format("; {}: all {} cache folders are in use by other workers",
                             root.string(), most_folders);
    } catch (const core::IoError& error) {
      reasons += fmt::format("; {}", error.what());
    }
  }
  throw core::IoError(
      fmt::format("no usable cache folder for {}; set XDG_CACHE_HOME to a folder that you own{}",
                  device_id, reasons));
}

core::PrivateFolder cache_folder(const std::string& name) {
  std::string reasons;
  for (const CachePlace& place : cache_places()) {
    try {
      const std::array names{place.name, name};
      return {place.root, names};
    } catch (const core::IoError& error) {
      reasons += fmt::format("; {}", error.what());
    }
  }
  throw core::IoError("no usable cache folder" + reasons);
}

std::vector<std::string> worker_environment(std::string_view device_id, const CacheFolder& cache,
                                            std::span<const std::string> overrides) {
  std::vector<std::string> result;
  for (const std::string& entry : overrides) result.push_back(with_cache(entry, cache));
  const auto overridden = [&](std::string_view name) {
    return std::ranges::any_of(
        overrides, [&](const std::string& entry) { return variable_name(entry) == name; });
  };
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (text.starts_with("BENCHMARK_") || overridden(variable_name(text))) continue;
    result.emplace_back(text);
  }
  for (const EnvironmentDefault& each : defaults) {
    const bool set = std::ranges::any_of(
        result, [&](const std::string& entry) { return variable_name(entry) == each.name; });
    if (set || !device_id.starts_with(each.api)) continue;
    result.push_back(with_cache(fmt::format("{}={}", each.name, each.value), cache));
  }
  return result;
}

std::vector<std::string> parse_environment(std::string_view text, const std::string& where) {
  std::vector<std::string> environment;
  for (std::string_view rest = text;;) {
    if (!starts_with_variable(rest)) {
      throw core::InputError(fmt::format("{}: expected NAME=VALUE, found '{}'", where, rest));
    }
    std::size_t end = rest.find(',');
    while (end != std::string_view::npos && !starts_with_variable(rest.substr(end + 1))) {
      end = rest.find(',', end + 1);
    }
    environment.emplace_back(rest.substr(0, end));
    if (end == std::string_view::npos) return environment;
    rest.remove_prefix(end + 1);
  }
}

std::vector<std::string> differing_driver_variables(std::span<const std::string> a,
                                                    std::span<const std::string> b) {
  const auto value = [](const std::string& name, std::span<const std::string> overrides) {
    const auto found = std::ranges::find(overrides, std::string_view(name), variable_name);
    return found == overrides.end() ? variable(name.c_str()) : found->substr(found->find('=') + 1);
  };
  std::vector<std::string> names;
  for (const record::DriverVariable& each : record::driver_variables) {
    const std::string name(each.name);
    if (value(name, a) != value(name, b)) names.push_back(name);
  }
  return names;
}

std::optional<std::string> reason_not_to_measure() {
  if (std::getenv("LP_PERF") == nullptr) return std::nullopt;
  const std::array<std::string, 1> set{"LP_PERF=" + variable("LP_PERF")};
  return reason_not_to_measure(set);
}

std::optional<std::string> reason_not_to_measure(std::span<const std::string> environment) {
  for (const std::string& entry : environment) {
    if (variable_name(entry) != "LP_PERF") continue;
    return fmt::format(
        "{} is set, which makes llvmpipe and lavapipe skip work, so that times and images would be "
        "wrong; unset it",
        entry);
  }
  return std::nullopt;
}

}  // namespace triptych::measure
