// Tests that the compiled SPIR-V, and not only its source, declares conservative depth.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "backends/vulkan/pipeline.hpp"

namespace triptych::vulkan_backend {
namespace {

// Values from the SPIR-V specification.
constexpr std::uint32_t op_execution_mode = 16;
constexpr std::uint32_t depth_replacing = 12;
constexpr std::uint32_t depth_greater = 14;
constexpr std::uint32_t depth_less = 15;

std::set<std::uint32_t> execution_modes(std::string_view code) {
  std::vector<std::uint32_t> words(code.size() / 4);
  std::memcpy(words.data(), code.data(), code.size());
  std::set<std::uint32_t> modes;
  constexpr std::size_t header = 5;
  for (std::size_t at = header; at < words.size(); at += words[at] >> 16U) {
    if ((words[at] & 0xFFFFU) == op_execution_mode) modes.insert(words.at(at + 2));
  }
  return modes;
}

// The SPIR-V that is used for timing and the SPIR-V that also counts its work must both declare
// conservative depth.
TEST(ConservativeDepth, IsDeclaredExactlyWhenItIsOn) {
  for (const std::string build : {"", "_counting"}) {
    SCOPED_TRACE(build);
    const auto modes = [&](const std::string& name) {
      return execution_modes(spirv(name + build + ".frag.spv"));
    };
    const auto off = modes("sphere");
    EXPECT_TRUE(off.contains(depth_replacing));
    EXPECT_FALSE(off.contains(depth_less) || off.contains(depth_greater));
    const auto on = modes("sphere_conservative");
    EXPECT_TRUE(on.contains(depth_less));
    EXPECT_FALSE(on.contains(depth_greater));
    const auto injected = modes("sphere_wrong_sense");
    EXPECT_TRUE(injected.contains(depth_greater));
    EXPECT_FALSE(injected.contains(depth_less));
  }
}

}  // namespace
}  // namespace triptych::vulkan_backend
