#pragma once
// Compile-only devices. Such a device is a driver's compiler for a GPU that this machine does not
// have. Its id contains the GPU family, for example `vulkan:radv-navi31`. Older releases of RADV
// compile without any GPU (RADV_FORCE_FAMILY). Newer releases, and all other drivers, use Mesa's
// stub of the kernel interface (package mesa-drm-shim), which pretends to be a GPU but executes
// nothing.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::measure {

// The reason that is reported if a compile-only device is used for drawing.
inline constexpr std::string_view only_compiles = "this device only compiles code and cannot draw";

struct CompileOnly {
  std::string driver;  // "radv", "radeonsi", "rusticl" or "nvk"
  std::string family;  // such as "navi31"
};

// Parses the id of a compile-only device. Returns nullopt for any other id. Every GPU family is
// accepted here, because only the driver knows which families it supports.
[[nodiscard]] std::optional<CompileOnly> compile_only(std::string_view device_id);

// Returns the compile-only devices that the gate uses by default. Their GPU families represent the
// most common GPUs.
[[nodiscard]] std::vector<std::string> default_compile_only_devices();

// Returns the variables ("NAME=VALUE") that a worker needs for this device. The result is empty
// unless the device is a compile-only device. `overrides` contains the variables that are set for
// the worker in addition to this process's environment. They may determine where drivers are found.
// Throws a core::NotSupported that names the missing package.
[[nodiscard]] std::vector<std::string> compile_only_environment(
    std::string_view device_id, std::span<const std::string> overrides = {});

// Returns the GPU family for which a driver compiles in this process. Returns an empty string if
// the driver's device executes code, as all CPU devices do. `driver` is the short name of the
// driver.
[[nodiscard]] std::string compiled_family(std::string_view driver);

// Removes the versions of the kernel and of its DRM interface from the GPU name that radeonsi
// reports, such as "AMD Radeon RX 6800 (radeonsi, navi21, LLVM 19.1.7, DRM 3.49, 6.12.1)". They do
// not affect the compiler, and a compile-only device must have the same name on every machine.
[[nodiscard]] std::string without_kernel_version(std::string text);

// Returns the id of a driver's compile-only device for `family`.
[[nodiscard]] std::string compile_only_id(std::string_view api, std::string_view driver,
                                          std::string_view family);

}  // namespace triptych::measure
