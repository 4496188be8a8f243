#pragma once
// The features and limits that a shader requires of the device, read from its SPIR-V.

#include <array>
#include <cstdint>
#include <set>
#include <span>

namespace triptych::layer {

struct ShaderNeeds {
  std::set<std::uint32_t> capabilities;
  std::uint32_t model = 0;                      // the execution model of its entry point
  std::array<std::uint32_t, 3> group{1, 1, 1};  // the size of a work group if it is not specialized
  std::uint64_t shared_bytes = 0;               // shared memory of a work group
  bool writes_buffers = false;                  // whether it writes buffers, by stores or atomics
};

[[nodiscard]] ShaderNeeds shader_needs(std::span<const std::uint32_t> code);

}  // namespace triptych::layer
