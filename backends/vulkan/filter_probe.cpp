#include "backends/vulkan/filter_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "backends/vulkan/memory.hpp"
#include "backends/vulkan/pipeline.hpp"
#include "backends/vulkan/volume_resources.hpp"
#include "core/random.hpp"
#include "scene/half.hpp"
#include "technique/volume/filter_bound.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr int edge = 8;  // voxels
constexpr std::size_t places = 8192;
constexpr std::uint32_t group_size = 64;  // as in filter_probe.comp
using Sample = std::array<float, 4>;      // position in voxels, and the value sampled there

vk::FormatFeatureFlags features(const Gpu& gpu, scene::VoxelFormat format) {
  return gpu.physical.getFormatProperties(texture_format(format)).optimalTilingFeatures;
}

// Creates a volume whose voxels are either the lowest or the highest value of the format.
scene::VoxelGrid random_voxels(scene::VoxelFormat format) {
  scene::VoxelGrid grid{.format = format, .size = {edge, edge, edge}};
  grid.data.resize(std::size_t{edge} * edge * edge * scene::bytes_of(format));
  core::Random random(1);
  const auto fill = [&](auto one) {
    for (std::size_t at = 0; at < grid.data.size(); at += sizeof one) {
      if (random.uniform() < 0.5) std::memcpy(&grid.data[at], &one, sizeof one);
    }
  };
  switch (format) {
    case scene::VoxelFormat::u8:
      fill(std::uint8_t{255});
      break;
    case scene::VoxelFormat::u16:
      fill(std::uint16_t{65535});
      break;
    case scene::VoxelFormat::f32:
      fill(1.0F);
      break;
    case scene::VoxelFormat::f16:
      fill(scene::to_half(1));
      break;
  }
  return grid;
}

std::vector<Sample> random_places() {
  core::Random random(2);
  std::vector<Sample> samples(places);
  for (Sample& each : samples) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      each.at(axis) = static_cast<float>(random.uniform(0, edge));
    }
  }
  return samples;
}

bool is_set(const scene::VoxelGrid& grid, const std::array<int, 3>& voxel) {
  std::size_t index = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    index = index * edge + static_cast<std::size_t>(std::clamp(voxel.at(axis), 0, edge - 1));
  }
  return grid.data[index * scene::bytes_of(grid.format) + scene::bytes_of(grid.format) - 1] !=
         std::byte{0};
}

double trilinear(const scene::VoxelGrid& grid, const Sample& place) {
  double value = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<int, 3> voxel{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double q = static_cast<double>(place.at(axis)) - 0.5;
      const bool upper = (corner >> axis & 1U) != 0;
      const double fraction = q - std::floor(q);
      weight *= upper ? fraction : 1 - fraction;
      voxel.at(axis) = static_cast<int>(std::floor(q)) + (upper ? 1 : 0);
    }
    if (is_set(grid, voxel)) value += weight;
  }
  return value;
}

// Samples the volume on the device, and fills in the sampled values.
void sample_on_device(const Gpu& gpu, const Image& volume, std::vector<Sample>& samples) {
  const auto bytes = std::as_writable_bytes(std::span(samples));
  using enum vk::DescriptorType;
  const Buffer buffer = make_buffer(
      gpu, bytes, vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferSrc);
  const std::array<vk::DescriptorSetLayoutBinding, 2> bindings{{
      {.binding = 0,
       .descriptorType = eCombinedImageSampler,
       .descriptorCount = 1,
       .stageFlags = vk::ShaderStageFlagBits::eCompute},
      {.binding = 1,
       .descriptorType = eStorageBuffer,
       .descriptorCount = 1,
       .stageFlags = vk::ShaderStageFlagBits::eCompute},
  }};
  const Layout layout = make_layout(gpu, bindings);
  const vk::Pipeline pipeline =
      compute_pipeline(gpu, layout, spirv("filter_probe.comp.spv"), Constants{});
  const vk::raii::DescriptorPool pool = make_pool(gpu, 1);
  const vk::DescriptorSet set = allocate_sets(gpu, pool, layout, 1).front();
  const vk::raii::Sampler sampler = make_sampler(gpu, vk::Filter::eLinear);
  bind_texture(gpu, set, 0, volume, sampler);
  bind_buffer(gpu, set, 1, eStorageBuffer, buffer);
  run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout.pipeline, 0, set, {});
    commands.dispatch(static_cast<std::uint32_t>(places) / group_size, 1, 1);
  });
  download(gpu, buffer, bytes);
}

}  // namespace

bool can_sample(const Gpu& gpu, scene::VoxelFormat format) {
  return bool(features(gpu, format) & vk::FormatFeatureFlagBits::eSampledImage);
}

bool can_filter(const Gpu& gpu, scene::VoxelFormat format) {
  return can_sample(gpu, format) &&
         bool(features(gpu, format) & vk::FormatFeatureFlagBits::eSampledImageFilterLinear);
}

std::optional<double> probe_filter(const Gpu& gpu, scene::VoxelFormat format) {
  if (!can_filter(gpu, format)) return std::nullopt;
  const scene::VoxelGrid grid = random_voxels(format);
  const Image volume = upload_volume(gpu, grid);
  std::vector<Sample> samples = random_places();
  sample_on_device(gpu, volume, samples);
  double worst = 0;
  for (const Sample& each : samples) {
    worst = std::max(worst, std::abs(static_cast<double>(each[3]) - trilinear(grid, each)));
  }
  return worst;
}

double allowed_filter_error(const Gpu& gpu, scene::VoxelFormat format) {
  return technique::allowed_filter_error(
      static_cast<int>(gpu.properties.limits.subTexelPrecisionBits), format);
}

}  // namespace triptych::vulkan_backend
