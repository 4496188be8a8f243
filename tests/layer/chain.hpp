#pragma once
// The connection of the layer with the loader and the driver.

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <string_view>

namespace triptych::layer {

// A command that the layer replaces.
struct Hook {
  // the fault for which it is replaced; empty if it is replaced for every lowered limit
  std::string_view change;
  std::string_view command;
  PFN_vkVoidFunction function;
};

template <class Function>
[[nodiscard]] Hook hook(std::string_view change, std::string_view command, Function* function) {
  return {change, command, reinterpret_cast<PFN_vkVoidFunction>(function)};
}

// Returns the function for this command in the next layer or in the driver. `handle` is an
// instance, physical device, device, queue or command buffer.
[[nodiscard]] PFN_vkVoidFunction next_of(const void* handle, const char* command);

template <class Command>
[[nodiscard]] Command next(const void* handle, const char* command) {
  return reinterpret_cast<Command>(next_of(handle, command));
}

// Prints a line to stderr which states that the application did something that a device with the
// lowered limit would reject. From then on, every submission fails.
VkResult refuse(std::string_view what);

[[nodiscard]] std::span<const Hook> description_hooks();
[[nodiscard]] std::span<const Hook> memory_hooks();
[[nodiscard]] std::span<const Hook> queue_hooks();
[[nodiscard]] std::span<const Hook> refusal_hooks();
[[nodiscard]] std::span<const Hook> state_fault_hooks();
[[nodiscard]] std::span<const Hook> command_fault_hooks();
[[nodiscard]] std::span<const Hook> query_fault_hooks();
[[nodiscard]] std::span<const Hook> submission_hooks();

// Performs the faults that occur when a device is destroyed.
void end_device();

}  // namespace triptych::layer
