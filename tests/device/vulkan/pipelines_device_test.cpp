// Tests that each combination of properties creates only one pipeline.
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "backends/vulkan/colour_target.hpp"
#include "backends/vulkan/devices.hpp"
#include "backends/vulkan/draw_pipeline.hpp"
#include "backends/vulkan/instance.hpp"
#include "vulkan_device_test_embedded.hpp"

namespace triptych::vulkan_backend {
namespace {

// The shaders of these tests use the first two bindings.
Layout layout_of(const Gpu& gpu, std::uint32_t bindings) {
  std::vector<vk::DescriptorSetLayoutBinding> all;
  for (std::uint32_t i = 0; i < bindings; ++i) {
    all.push_back({.binding = i,
                   .descriptorType = vk::DescriptorType::eStorageBuffer,
                   .descriptorCount = 1,
                   .stageFlags = vk::ShaderStageFlagBits::eCompute});
  }
  return make_layout(gpu, all);
}

template <typename Check>
void for_each_gpu(Check&& check) {
  const Instance instance;
  for (const Candidate& each : candidates(instance.physical_devices())) {
    SCOPED_TRACE(each.info.id);
    check(open_gpu(each.physical));
  }
}

TEST(VulkanPipelines, OnePerCodeConstantsAndLayout) {
  for_each_gpu([](const Gpu& gpu) {
    const auto made = [&](std::string_view code, std::int32_t leaps, std::uint32_t bindings) {
      return compute_pipeline(gpu, layout_of(gpu, bindings), test_shaders::embedded(code),
                              Constants{.leaps = leaps});
    };
    const std::set<vk::Pipeline> different{
        made("maths.comp.spv", 0, 2), made("loop.comp.spv", 0, 2), made("maths.comp.spv", 1, 2),
        made("maths.comp.spv", 0, 3)};
    EXPECT_EQ(different.size(), 4U);
    EXPECT_TRUE(different.contains(made("maths.comp.spv", 0, 2)));
  });
}

TEST(VulkanPipelines, OnePerDrawState) {
  for_each_gpu([](const Gpu& gpu) {
    if (!gpu.draws) return;
    const auto made = [&](vk::Format format, std::uint32_t edge) {
      const auto pass = colour_pass(gpu, format, vk::AttachmentLoadOp::eClear);
      const std::vector<DrawStage> stages{
          {vk::ShaderStageFlagBits::eVertex, spirv("raycast_fragment.vert.spv")},
          {vk::ShaderStageFlagBits::eFragment, test_shaders::embedded("plain.frag.spv")}};
      return draw_pipeline(gpu, make_layout(gpu, {}), pass,
                           {.stages = stages, .extent = {edge, edge, 1}, .formats = {format}},
                           Specialization(Constants{}));
    };
    using enum vk::Format;
    const std::set<vk::Pipeline> different{made(eR8G8B8A8Unorm, 8), made(eR32G32B32A32Sfloat, 8),
                                           made(eR8G8B8A8Unorm, 16)};
    EXPECT_EQ(different.size(), 3U);
    EXPECT_TRUE(different.contains(made(eR8G8B8A8Unorm, 8)));
  });
}

}  // namespace
}  // namespace triptych::vulkan_backend
