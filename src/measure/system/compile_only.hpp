#pragma once
// Devices that only compile: the compiler for a GPU that this machine does not have, which is named
// by its family, such as `vulkan:radv-navi31`. RADV needs no device at all. The other drivers find
// one in Mesa's stub of the kernel interface (package mesa-drm-shim), which executes nothing.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::measure {

// The reason why such a device can be used only for compiling.
inline constexpr std::string_view only_compiles =
    "this device only compiles: nothing is executed on it";

struct CompileOnly {
  std::string driver;  // "radv", "radeonsi", "rusticl" or "nvk"
  std::string family;  // "navi31"
};

// Parses the id of a device that only compiles; returns nullopt for any other id. Any family may be
// named; the driver decides whether it supports it.
[[nodiscard]] std::optional<CompileOnly> compile_only(std::string_view device_id);

// The devices for which the gate compiles if the user names none: families that cover the market.
[[nodiscard]] std::vector<std::string> usual_compile_only_devices();

// The variables ("NAME=VALUE") that a worker of such a device needs; none for other devices.
// `overrides` are the worker's other variables, which may state where drivers are. Throws
// core::NotSupported with the name of the package that is missing.
[[nodiscard]] std::vector<std::string> compile_only_environment(
    std::string_view device_id, std::span<const std::string> overrides = {});

// The family for which the drivers of this process compile; empty if their devices execute code.
// `driver` is its short name. It is always empty for drivers that compute on the processor.
[[nodiscard]] std::string compiled_family(std::string_view driver);

// Removes the versions of the kernel and of its DRM interface from the name that radeonsi gives a
// GPU: "AMD Radeon RX 6800 (radeonsi, navi21, LLVM 19.1.7, DRM 3.49, 6.12.1)". They do not affect a
// compiler, and a device that only compiles must be the same on every machine.
[[nodiscard]] std::string without_kernel_version(std::string text);

// The id for a driver's device that only compiles for `family`.
[[nodiscard]] std::string compile_only_id(std::string_view api, std::string_view driver,
                                          std::string_view family);

}  // namespace triptych::measure
