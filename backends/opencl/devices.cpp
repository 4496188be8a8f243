#include "backends/opencl/devices.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <map>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "measure/system/compile_only.hpp"
#include "measure/system/cpu_features.hpp"
#include "record/device_id.hpp"

namespace triptych::opencl_backend {
namespace {

// The environment variables that determine the devices, the number of threads and the generated
// code of these drivers.
constexpr auto variables = std::to_array<std::string_view>(
    {"GALLIUM_DRIVER", "GALLIUM_OVERRIDE_CPU_CAPS", "GALLIVM_PERF", "LP_NATIVE_VECTOR_WIDTH",
     "LP_NUM_THREADS", "POCL_AFFINITY", "POCL_BITCODE_FINALIZER", "POCL_CPU_LOCAL_MEM_SIZE",
     "POCL_CPU_MAX_CU_COUNT", "POCL_DEVICES", "POCL_EXTRA_BUILD_FLAGS", "POCL_MAX_PTHREAD_COUNT",
     "POCL_MAX_WORK_GROUP_SIZE", "POCL_PTHREAD_MAX_WGS", "POCL_PTHREAD_MIN_WGS",
     "POCL_WORK_GROUP_METHOD", "POCL_WORK_GROUP_SPECIALIZATION", "RUSTICL_ENABLE",
     "RUSTICL_FEATURES"});

std::map<std::string, std::string> environment() {
  auto set = measure::set_variables(variables);
  // Triptych itself sets this variable to 1 for its workers. It is omitted from the device's
  // description, so that the description is the same inside and outside of a worker.
  if (const auto found = set.find("POCL_PTHREAD_MIN_WGS");
      found != set.end() && found->second == "1") {
    set.erase(found);
  }
  return set;
}

// Strings from the API may end in a NUL or in spaces, and some contain line breaks.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = ' ';
  }
  const auto end = text.find_last_not_of(' ');
  text.resize(end == std::string::npos ? 0 : end + 1);
  return text;
}

template <cl_device_info Name>
std::string number(const cl::Device& device) {
  return fmt::format("{}", checked([&] { return device.getInfo<Name>(); }));
}

std::map<std::string, std::string> limits_of(const cl::Device& device) {
#define TRI_LIMIT(name) \
  { #name, number < name>(device) }
  return {TRI_LIMIT(CL_DEVICE_GLOBAL_MEM_SIZE),    TRI_LIMIT(CL_DEVICE_IMAGE3D_MAX_DEPTH),
          TRI_LIMIT(CL_DEVICE_IMAGE3D_MAX_HEIGHT), TRI_LIMIT(CL_DEVICE_IMAGE3D_MAX_WIDTH),
          TRI_LIMIT(CL_DEVICE_IMAGE_SUPPORT),      TRI_LIMIT(CL_DEVICE_MAX_COMPUTE_UNITS),
          TRI_LIMIT(CL_DEVICE_MAX_MEM_ALLOC_SIZE), TRI_LIMIT(CL_DEVICE_MAX_WORK_GROUP_SIZE)};
#undef TRI_LIMIT
}

// Returns whether this is a layered driver, which forwards all work to another driver. The results
// depend on both drivers.
bool is_layered(std::string_view driver) {
  return driver == "rusticl" || driver == "clvk" || driver == "clon12";
}

// Returns the driver version, for example "22.3.6 on llvmpipe (LLVM 15.0.6, 256 bits)".
std::string version_of(const cl::Device& device, const std::string& driver) {
  std::string version = one_line(device.getInfo<CL_DRIVER_VERSION>());
  if (is_layered(driver)) version += " on " + one_line(device.getInfo<CL_DEVICE_NAME>());
  return version;
}

record::Device describe(const cl::Device& device, const std::string& driver) {
  return checked([&] {
    const bool cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
    return record::Device{.id = "opencl:" + driver,
                          .api = "opencl",
                          .name = one_line(device.getInfo<CL_DEVICE_NAME>()),
                          .vendor = one_line(device.getInfo<CL_DEVICE_VENDOR>()),
                          .driver = driver,
                          .driver_version = version_of(device, driver),
                          .api_version = one_line(device.getInfo<CL_DEVICE_VERSION>()),
                          .cpu_features = cpu ? measure::cpu_features() : std::string(),
                          .environment = environment(),
                          .limits = limits_of(device)};
  });
}

// For a device that only compiles, sets the id to one that contains the GPU family selected by the
// environment variables.
void compile_only_for_driver(const std::string& driver, record::Device& info) {
  if (!info.cpu_features.empty()) return;
  std::string family = measure::compiled_family(driver);
  if (family.empty()) return;
  info.id = measure::compile_only_id("opencl", driver, family);
  info.compiles_for = std::move(family);
  info.name = measure::without_kernel_version(std::move(info.name));
  info.driver_version = measure::without_kernel_version(std::move(info.driver_version));
  info.environment.clear();
}

// Returns the reason why the device cannot be used; empty if it can.
std::string unusable_reason(const cl::Device& device) {
  return checked([&]() -> std::string {
    if (device.getInfo<CL_DEVICE_AVAILABLE>() == CL_FALSE) return "CL_DEVICE_AVAILABLE is false";
    if (device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>() == CL_FALSE) {
      return "CL_DEVICE_COMPILER_AVAILABLE is false";
    }
    const std::string version = device.getInfo<CL_DEVICE_VERSION>();
    if (version.starts_with("OpenCL 1.0") || version.starts_with("OpenCL 1.1")) {
      return fmt::format("the device supports only {}; OpenCL 1.2 is required", one_line(version));
    }
    return {};
  });
}

void add_device(Search& search, const cl::Device& device, const std::string& driver,
                std::map<std::string, int>& seen) {
  // Devices are numbered before any of them is tested, so that an id does not depend on whether
  // another device works.
  const std::string id = record::numbered_id("opencl:" + driver, ++seen[driver]);
  try {
    if (const std::string reason = unusable_reason(device); !reason.empty()) {
      search.broken.push_back({"OpenCL device " + id, reason});
      return;
    }
    Found found{.device = device, .info = describe(device, driver)};
    found.info.id = id;
    compile_only_for_driver(driver, found.info);
    search.found.push_back(std::move(found));
  } catch (const core::ApiError& error) {
    search.broken.push_back({"OpenCL device " + id, error.what()});
  }
}

void add_platform(Search& search, const cl::Platform& platform, std::map<std::string, int>& seen) {
  std::string name = "without a name";
  try {
    name = one_line(checked([&] { return platform.getInfo<CL_PLATFORM_NAME>(); }));
    std::vector<cl::Device> devices;
    const cl_int code = platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    if (code != CL_SUCCESS || devices.empty()) {
      search.broken.push_back({"OpenCL platform " + name, "it reports no devices"});
      return;
    }
    const std::string driver = driver_of(name);
    for (const cl::Device& device : devices) add_device(search, device, driver, seen);
  } catch (const cl::Error& error) {
    // A platform that is disabled or has no hardware returns this code instead of an empty list.
    search.broken.push_back(
        {"OpenCL platform " + name,
         error.err() == CL_DEVICE_NOT_FOUND
             ? "it reports no devices"
             : fmt::format("{} returned {}", error.what(), code_name(error.err()))});
  } catch (const core::ApiError& error) {
    search.broken.push_back({"OpenCL platform " + name, error.what()});
  }
}

}  // namespace

std::string driver_of(std::string_view platform_name) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 9> known{{
      {"clvk", "clvk"},
      {"OpenCLOn12", "clon12"},
      {"Portable Computing Language", "pocl"},
      {"rusticl", "rusticl"},
      {"Clover", "clover"},
      {"NVIDIA", "nvidia"},
      {"AMD", "amd"},
      {"Intel", "intel"},
      {"Apple", "apple"},
  }};
  for (const auto& [start, driver] : known) {
    if (platform_name.starts_with(start)) return std::string(driver);
  }
  std::string driver;
  for (const char c : platform_name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) != 0) driver += static_cast<char>(std::tolower(letter));
  }
  return driver.empty() ? "unknown" : driver;
}

Search find_devices() {
  Search search;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error& error) {
    search.broken.push_back(
        {"OpenCL loader", fmt::format("{} returned {}", error.what(), code_name(error.err()))});
    return search;
  }
  if (platforms.empty()) search.broken.push_back({"OpenCL loader", "it reports no platforms"});
  std::map<std::string, int> seen;
  for (const cl::Platform& platform : platforms) add_platform(search, platform, seen);
  return search;
}

}  // namespace triptych::opencl_backend
