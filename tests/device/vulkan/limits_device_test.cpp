// Tests devices with smaller limits, which are simulated by lowering the limits that the machine's
// devices report.
#include <gmock/gmock.h>

#include <algorithm>

#include "backends/vulkan/descriptors.hpp"
#include "backends/vulkan/devices.hpp"
#include "backends/vulkan/filter_probe.hpp"
#include "backends/vulkan/instance.hpp"
#include "backends/vulkan/support.hpp"
#include "core/error.hpp"
#include "tests/device/vulkan/vulkan_devices.hpp"

namespace triptych::vulkan_backend {
namespace {

using technique::Skip;
using testing::AllOf;
using testing::HasSubstr;

template <class Check>
void for_each_limited(std::uint32_t storage_range, Check&& check) {
  const Instance instance;
  for (const Candidate& each : candidates(instance.physical_devices())) {
    SCOPED_TRACE(each.info.id);
    Gpu gpu = open_gpu(each.physical);
    std::uint32_t& most = gpu.properties.limits.maxStorageBufferRange;
    most = std::min(most, storage_range);
    check(gpu);
  }
}

std::string reason(const Gpu& gpu, std::string_view technique, const scene::VolumeScene& scene,
                   Skip skip) {
  const Needs needs = technique == "raycast" ? Needs::nothing : Needs::drawing;
  return volume_reason(gpu, {scene, {.skip = skip}}, technique, needs).value_or("");
}

TEST(VulkanLimits, CountersAndBrickMapsAreCheckedAgainstLimits) {
  constexpr std::uint32_t most = 1U << 20U;
  for_each_limited(most, [](const Gpu& gpu) {
    scene::VolumeScene scene = make_scene({.voxel = scene::VoxelFormat::u8, .width = 128});
    auto grid = *scene.grid;
    grid.size = {200, 200, 200};  // 10⁶ bricks of 2³ cells
    for (const std::string_view technique : {"raycast", "raycast_fragment"}) {
      scene.grid = std::make_shared<const scene::VoxelGrid>(grid);
      scene.height = 128;
      EXPECT_THAT(reason(gpu, technique, scene, Skip::distance),
                  AllOf(HasSubstr("brick map"), HasSubstr("maxStorageBufferRange is 1048576")));
      EXPECT_EQ(reason(gpu, technique, scene, Skip::bricks), "");
      scene.height = 256;  // the largest height that fits, with 32 bytes of counters per pixel
      EXPECT_EQ(reason(gpu, technique, scene, Skip::bricks), "");
      scene.height = 257;
      EXPECT_THAT(reason(gpu, technique, scene, Skip::bricks),
                  HasSubstr("maxStorageBufferRange is 1048576"));
    }
  });
}

TEST(VulkanLimits, ABufferIsBoundCompletelyOrNotAtAll) {
  constexpr std::uint32_t most = 4096;
  for_each_limited(most, [](const Gpu& gpu) {
    using enum vk::DescriptorType;
    const vk::DescriptorSetLayoutBinding binding{.descriptorType = eStorageBuffer,
                                                 .descriptorCount = 1,
                                                 .stageFlags = vk::ShaderStageFlagBits::eCompute};
    const Layout layout = make_layout(gpu, binding);
    const vk::raii::DescriptorPool pool = make_pool(gpu, 1);
    const vk::DescriptorSet set = allocate_sets(gpu, pool, layout, 1).front();
    const auto buffer = [&](vk::DeviceSize bytes) {
      return Buffer(gpu, bytes, vk::BufferUsageFlagBits::eStorageBuffer, Place::device);
    };
    const Buffer fits = buffer(most);
    const Buffer larger = buffer(most + 4);
    EXPECT_NO_THROW(bind_buffer(gpu, set, 0, eStorageBuffer, fits));
    EXPECT_THROW(bind_buffer(gpu, set, 0, eStorageBuffer, larger), core::NotSupported);
  });
}

// A filter whose error exceeds the allowed error is faulty, and such an error must not widen the
// bound of images.
TEST(VulkanLimits, TheAllowedFilterErrorFollowsFromFormatAndWeights) {
  using enum scene::VoxelFormat;
  const Instance instance;
  for (const Candidate& each : candidates(instance.physical_devices())) {
    SCOPED_TRACE(each.info.id);
    Gpu gpu = open_gpu(each.physical);
    for (const scene::VoxelFormat format : {u8, u16, f32, f16}) {
      const double error = probe_filter(gpu, format).value_or(0);
      EXPECT_LE(error, allowed_filter_error(gpu, format)) << scene::name_of(format);
    }
    gpu.properties.limits.subTexelPrecisionBits = 4;
    EXPECT_GT(allowed_filter_error(gpu, f32), 3.0 / 16);
  }
}

}  // namespace
}  // namespace triptych::vulkan_backend
