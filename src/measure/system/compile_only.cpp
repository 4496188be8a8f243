#include "measure/system/compile_only.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"

namespace triptych::measure {
namespace fs = std::filesystem;
namespace {

struct Driver {
  std::string_view id;    // the beginning of device ids; the GPU family follows
  std::string_view name;  // short name of the driver
  std::string_view stub;  // the library with the stub of the kernel interface
  std::string_view icd;   // beginning of the Vulkan driver's file name; empty: not a Vulkan driver
};
constexpr std::array<Driver, 4> drivers{{
    {"vulkan:radv-", "radv", "libamdgpu_noop_drm_shim.so", "radeon_icd"},
    {"vulkan:nvk-", "nvk", "libnouveau_noop_drm_shim.so", "nouveau_icd"},
    {"gl:radeonsi-", "radeonsi", "libamdgpu_noop_drm_shim.so", ""},
    {"opencl:rusticl-", "rusticl", "libamdgpu_noop_drm_shim.so", ""},
}};

// The chip that the stub of the nouveau kernel driver simulates for each GPU family.
struct Chip {
  std::string_view family;
  std::string_view chipset;
};
constexpr std::array<Chip, 2> chips{{{"turing", "0x164"}, {"ampere", "0x172"}}};

constexpr std::array<std::string_view, 9> default_devices{
    "vulkan:radv-polaris10", "vulkan:radv-vega10",  "vulkan:radv-navi21",
    "vulkan:radv-navi31",    "vulkan:radv-gfx1201", "vulkan:nvk-turing",
    "vulkan:nvk-ampere",     "gl:radeonsi-navi31",  "opencl:rusticl-navi31"};

const Driver* driver_of(std::string_view device_id) {
  const auto* const found = std::ranges::find_if(
      drivers, [&](const Driver& each) { return device_id.starts_with(each.id); });
  return found == drivers.end() ? nullptr : found;
}

bool is_family(std::string_view text) {
  const auto plain = [](char c) {
    return std::islower(static_cast<unsigned char>(c)) != 0 ||
           std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  return !text.empty() && std::ranges::all_of(text, plain);
}

// Returns the value that the variable will have in a worker.
std::string value_of(std::string_view name, std::span<const std::string> overrides) {
  for (const std::string& entry : overrides) {
    if (entry.starts_with(fmt::format("{}=", name))) return entry.substr(name.size() + 1);
  }
  const char* value = std::getenv(std::string(name).c_str());
  return value == nullptr ? std::string() : std::string(value);
}

std::vector<std::string> parts_of(std::string_view text) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t colon = text.find(':');
    if (colon != 0) parts.emplace_back(text.substr(0, colon));
    text.remove_prefix(colon == std::string_view::npos ? text.size() : colon + 1);
  }
  return parts;
}

std::string file_in(const fs::path& folder, std::string_view start, std::string_view ending) {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(start) && name.ends_with(ending)) found.push_back(entry.path().string());
  }
  std::ranges::sort(found);
  return found.empty() ? std::string() : found.front();
}

// Returns the first JSON file whose name begins with `start`. Searches the folders of the driver
// files that the environment names, and then the folders that the Vulkan loader searches.
std::string find_icd(std::string_view start, std::span<const std::string> overrides) {
  std::vector<fs::path> folders;
  for (const char* variable : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
    for (const std::string& file : parts_of(value_of(variable, overrides))) {
      folders.push_back(fs::path(file).parent_path());
    }
  }
  for (const std::string& folder : parts_of(value_of("XDG_DATA_DIRS", overrides))) {
    folders.push_back(fs::path(folder) / "vulkan/icd.d");
  }
  for (const char* folder : {"/usr/local/share/vulkan/icd.d", "/usr/share/vulkan/icd.d",
                             "/usr/local/etc/vulkan/icd.d", "/etc/vulkan/icd.d"}) {
    folders.emplace_back(folder);
  }
  for (const fs::path& folder : folders) {
    if (std::string file = file_in(folder, start, ".json"); !file.empty()) return file;
  }
  return {};
}

std::string find_library(std::string_view name, std::span<const std::string> overrides) {
  std::vector<fs::path> folders;
  for (const std::string& folder : parts_of(value_of("LD_LIBRARY_PATH", overrides))) {
    folders.emplace_back(folder);
  }
  std::error_code error;
  for (const char* root : {"/usr/local/lib", "/usr/lib64", "/usr/lib"}) {
    folders.emplace_back(root);
    for (const auto& entry : fs::directory_iterator(root, error)) {
      const std::string folder = entry.path().filename().string();
      if (folder.ends_with("-linux-gnu")) folders.push_back(entry.path());
    }
  }
  for (const fs::path& folder : folders) {
    if (fs::exists(folder / name, error)) return (folder / name).string();
  }
  return {};
}

// Returns whether this RADV driver reads RADV_FORCE_FAMILY, in which case it needs no stub. Newer
// releases, such as Mesa 26.1, do not read it. They contain a message that the variable has been
// removed, by which this function recognizes them.
bool supports_force_family(const std::string& icd, std::span<const std::string> overrides) {
  try {
    const std::string library =
        core::Json::parse(core::read_text(icd)).at("ICD").at("library_path");
    const fs::path file = library.find('/') == std::string::npos
                              ? fs::path(find_library(library, overrides))
                              : fs::path(icd).parent_path() / library;
    constexpr std::string_view removed = "RADV_FORCE_FAMILY=<family> has been removed";
    const std::vector<std::byte> bytes = core::read_file(file);
    return std::ranges::search(bytes, std::as_bytes(std::span(removed))).empty();
  } catch (const std::exception&) {
    return true;  // the driver's files are broken or missing, which the loader will report
  }
}

void add_stub(const Driver& driver, const std::string& family,
              std::span<const std::string> overrides, std::vector<std::string>& environment) {
  const std::string stub = find_library(driver.stub, overrides);
  if (stub.empty()) {
    throw core::NotSupported(
        fmt::format("{} is missing; install the package mesa-drm-shim (available in Debian 13 and "
                    "bookworm-backports)",
                    driver.stub));
  }
  const std::string before = value_of("LD_PRELOAD", overrides);
  environment.push_back(fmt::format("LD_PRELOAD={}{}{}", stub, before.empty() ? "" : ":", before));
  if (driver.name != "nvk") {
    environment.push_back("AMDGPU_GPU_ID=" + family);
    return;
  }
  const auto* const chip = std::ranges::find(chips, family, &Chip::family);
  if (chip == chips.end()) {
    throw core::NotSupported(fmt::format(
        "the stub of the nouveau kernel driver supports 'turing' and 'ampere', but not '{}'",
        family));
  }
  environment.push_back(fmt::format("NOUVEAU_CHIPSET={}", chip->chipset));
  environment.emplace_back("NVK_I_WANT_A_BROKEN_VULKAN_DRIVER=1");
}

}  // namespace

std::optional<CompileOnly> compile_only(std::string_view device_id) {
  const Driver* driver = driver_of(device_id);
  if (driver == nullptr) return std::nullopt;
  const std::string_view family = device_id.substr(driver->id.size());
  if (!is_family(family) || family == "egl" || family == "osmesa") return std::nullopt;
  return CompileOnly{std::string(driver->name), std::string(family)};
}

std::vector<std::string> default_compile_only_devices() {
  return {default_devices.begin(), default_devices.end()};
}

std::vector<std::string> compile_only_environment(std::string_view device_id,
                                                  std::span<const std::string> overrides) {
  const auto device = compile_only(device_id);
  if (!device) return {};
  const Driver& driver = *driver_of(device_id);
  // Turns off caches, because the driver does not report statistics for a program that it loads
  // from a cache.
  std::vector<std::string> environment{"MESA_SHADER_CACHE_DISABLE=true"};
  std::string icd;
  if (!driver.icd.empty()) {
    icd = find_icd(driver.icd, overrides);
    if (icd.empty()) {
      throw core::NotSupported(
          fmt::format("no Vulkan driver file {}*.json was found; install the package "
                      "mesa-vulkan-drivers{}",
                      driver.icd, driver.name == "nvk" ? " from Debian 13 or later" : ""));
    }
    environment.push_back("VK_DRIVER_FILES=" + icd);
    environment.push_back("VK_ICD_FILENAMES=" + icd);  // read by loaders before version 1.3.207
  }
  if (driver.name == "radv" && supports_force_family(icd, overrides)) {
    environment.push_back("RADV_FORCE_FAMILY=" + device->family);
  } else {
    add_stub(driver, device->family, overrides, environment);
  }
  if (driver.name == "radeonsi") {
    // The driver reports statistics and disassembly for the shader stages that are listed here.
    environment.emplace_back("AMD_DEBUG=vs,tcs,tes,gs,ps,cs,asm");
    environment.emplace_back("LIBGL_ALWAYS_SOFTWARE=false");
  } else if (driver.name == "rusticl") {
    environment.emplace_back("AMD_DEBUG=cs,asm");
    environment.emplace_back("RUSTICL_DEBUG=nir");  // prints the names of the kernels
    environment.emplace_back("RUSTICL_ENABLE=radeonsi");
  }
  return environment;
}

std::string compiled_family(std::string_view driver) {
  if (driver == "radv") {
    if (std::string family = value_of("RADV_FORCE_FAMILY", {}); !family.empty()) return family;
  }
  if (value_of("LD_PRELOAD", {}).find("_noop_drm_shim") == std::string::npos) return {};
  const std::string chipset = value_of("NOUVEAU_CHIPSET", {});
  if (driver == "nvk" && !chipset.empty()) {
    const auto* const chip = std::ranges::find(chips, chipset, &Chip::chipset);
    return chip == chips.end() ? chipset : std::string(chip->family);
  }
  const std::string family = value_of("AMDGPU_GPU_ID", {});
  return family.empty() ? "stub" : family;
}

std::string without_kernel_version(std::string text) {
  const std::size_t begin = text.find(", DRM ");
  const std::size_t end = text.find(')', begin);
  if (begin != std::string::npos && end != std::string::npos) text.erase(begin, end - begin);
  return text;
}

std::string compile_only_id(std::string_view api, std::string_view driver,
                            std::string_view family) {
  std::string id = fmt::format("{}:{}-{}", api, driver, family);
  std::ranges::transform(id, id.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return id;
}

}  // namespace triptych::measure
