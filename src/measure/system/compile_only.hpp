#pragma once
// Devices that only compile: the compiler of a GPU that is not here, asked for by its family, such
// as `vulkan:radv-navi31`. RADV needs no device at all; the other drivers find one in Mesa's stub
// of the kernel interface (package mesa-drm-shim), which executes nothing.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::measure {

// Why nothing but compiling may be asked of such a device.
inline constexpr std::string_view only_compiles =
    "this device only compiles: nothing is executed on it";

struct CompileOnly {
  std::string driver;  // "radv", "radeonsi", "rusticl" or "nvk"
  std::string family;  // "navi31"
};

// Parses the id of a device that only compiles; returns nullopt for any other id. Any family may be
// named; the driver decides whether it supports it.
[[nodiscard]] std::optional<CompileOnly> compile_only(std::string_view device_id);

// The devices that a gate compiles for where nobody names any: families that cover the market.
[[nodiscard]] std::vector<std::string> usual_compile_only_devices();

// The variables, "NAME=VALUE" each, that a worker of such a device needs; none for another device.
// `overrides` are the variables that a worker gets anyway: they may say where drivers are. Throws
// core::NotSupported naming the package that has what is missing.
[[nodiscard]] std::vector<std::string> compile_only_environment(
    std::string_view device_id, std::span<const std::string> overrides = {});

// The family that drivers of this process compile for: "" where their devices execute. `driver`:
// its short name. Devices that compute on the processor are never concerned.
[[nodiscard]] std::string compiled_family(std::string_view driver);

// `id` of a driver's device as one that only compiles for `family`.
[[nodiscard]] std::string compile_only_id(std::string_view api, std::string_view driver,
                                          std::string_view family);

}  // namespace triptych::measure
