#include "backends/vulkan/features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "backends/vulkan/errors.hpp"
#include "backends/vulkan/feature_kernel.hpp"
#include "core/error.hpp"

namespace triptych::vulkan_backend {
namespace {

using measure::count_right;
using measure::judged_feature;
using measure::ProbedFeature;
using Words = std::vector<std::uint32_t>;

ProbedFeature probe_groups(const Gpu& gpu) {
  const auto& most = gpu.properties.limits.maxComputeWorkGroupCount;
  const std::array<std::uint32_t, 3> groups{std::min(most[0], 100'003U), std::min(most[1], 2U), 2};
  const std::size_t count = std::size_t{groups[0]} * groups[1] * groups[2];
  const Kernel kernel(gpu, "features_groups.comp.spv", {storage_type});
  const Buffer numbers = result_buffer(gpu, count);
  bind_buffer(gpu, kernel.set(), 0, storage_type, numbers);
  run_once(gpu, [&](const auto& commands) { kernel.record(commands, groups); });
  const Words found = read_back<std::uint32_t>(gpu, numbers, count);
  return judged_feature(count_right(found, [](std::size_t i) { return i + 1; }), count,
                        fmt::format("{} x {} x {} groups", groups[0], groups[1], groups[2]));
}

ProbedFeature probe_push_constants(const Gpu& gpu) {
  std::array<std::uint32_t, 32> words{};
  for (std::uint32_t i = 0; i < words.size(); ++i) words[i] = 0x01010101U * (i + 1);
  const Kernel kernel(gpu, "features_push.comp.spv", {storage_type}, sizeof words);
  const Buffer numbers = result_buffer(gpu, words.size());
  bind_buffer(gpu, kernel.set(), 0, storage_type, numbers);
  run_once(gpu, [&](const auto& commands) { kernel.record(commands, words, {1, 1, 1}); });
  const Words found = read_back<std::uint32_t>(gpu, numbers, words.size());
  return judged_feature(count_right(found, [&](std::size_t i) { return words[i]; }), words.size(),
                        fmt::format("{} bytes", sizeof words));
}

// Reads words from any position in a buffer.
Words read_words(const Gpu& gpu, const Buffer& from, vk::DeviceSize offset, std::size_t count) {
  const Buffer near(gpu, count * sizeof(std::uint32_t), storage_usage, Place::device);
  run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(from.get(), near.get(),
                        vk::BufferCopy{.srcOffset = offset, .size = near.size()});
  });
  return read_back<std::uint32_t>(gpu, near, count);
}

struct Line {
  std::uint32_t first;
  std::uint32_t factor;
  [[nodiscard]] std::uint32_t at(std::size_t i) const {
    return first + factor * static_cast<std::uint32_t>(i);
  }
};

std::uint64_t largest_allocation(const Gpu& gpu) {
  std::uint64_t heap = 0;
  for (std::uint32_t i = 0; i < gpu.memory.memoryHeapCount; ++i) {
    heap = std::max<std::uint64_t>(heap, gpu.memory.memoryHeaps[i].size);
  }
  return std::min(gpu.most_allocated > 0 ? gpu.most_allocated : heap, heap);
}

// Runs the same kernel at the beginning of a buffer and at `offset`. If the driver dropped the
// upper bits of the offset, the second run would overwrite the beginning.
ProbedFeature probe_offset(const Gpu& gpu, std::uint64_t offset) {
  constexpr std::size_t count = 65536;
  constexpr std::uint64_t bytes = count * sizeof(std::uint32_t);
  const std::uint64_t needed = offset + bytes;
  if (const std::uint64_t most = largest_allocation(gpu); needed > most) {
    throw core::NotSupported(fmt::format(
        "needs a buffer of {} bytes, but the device can allocate at most {} bytes", needed, most));
  }
  const Buffer buffer(gpu, needed, storage_usage, Place::device);
  const Kernel kernel(gpu, "features_write.comp.spv", {storage_type}, sizeof(Line));
  const std::array<std::pair<std::uint64_t, Line>, 2> places{
      {{0, {.first = 7, .factor = 3}}, {offset, {.first = 11, .factor = 5}}}};
  for (const auto& [place, line] : places) {
    kernel.bind_range(0, storage_type, buffer, place, bytes);
    run_once(gpu, [&](const auto& commands) { kernel.record(commands, line, {count / 64, 1, 1}); });
  }
  std::uint64_t right = 0;
  for (const auto& [place, line] : places) {
    const Words found = read_words(gpu, buffer, place, count);
    right += count_right(found, [&](std::size_t i) { return line.at(i); });
  }
  return judged_feature(right, 2 * count, fmt::format("offset of {} bytes", offset));
}

ProbedFeature probe_dynamic_offsets(const Gpu& gpu) {
  constexpr std::uint32_t dispatches = 512;
  const auto alignment = static_cast<std::uint32_t>(
      std::max<vk::DeviceSize>(gpu.properties.limits.minStorageBufferOffsetAlignment, 256));
  const std::uint32_t words = alignment / sizeof(std::uint32_t);
  constexpr auto dynamic = vk::DescriptorType::eStorageBufferDynamic;
  const Kernel kernel(gpu, "features_write.comp.spv", {dynamic}, sizeof(Line));
  const Buffer numbers = result_buffer(gpu, std::size_t{dispatches} * words);
  kernel.bind_range(0, dynamic, numbers, 0, 64 * sizeof(std::uint32_t));
  run_once(gpu, [&](const auto& commands) {
    for (std::uint32_t n = 0; n < dispatches; ++n) {
      kernel.record(commands, Line{.first = 1000 * n, .factor = 1}, {1, 1, 1}, {n * alignment});
    }
  });
  const Words found = read_back<std::uint32_t>(gpu, numbers, std::size_t{dispatches} * words);
  std::uint64_t right = 0;
  for (std::uint32_t n = 0; n < dispatches; ++n) {
    for (std::uint32_t i = 0; i < 64; ++i) right += found[n * words + i] == 1000 * n + i ? 1U : 0U;
  }
  return judged_feature(right, std::uint64_t{64} * dispatches,
                        fmt::format("{} offsets", dispatches));
}

ProbedFeature probe_subgroups(const Gpu& gpu) {
  const auto subgroups =
      gpu.physical
          .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties>()
          .get<vk::PhysicalDeviceSubgroupProperties>();
  if (!(subgroups.supportedOperations & vk::SubgroupFeatureFlagBits::eArithmetic) ||
      !(subgroups.supportedStages & vk::ShaderStageFlagBits::eCompute)) {
    throw core::NotSupported("the device does not support subgroup arithmetic in compute shaders");
  }
  constexpr std::uint32_t groups = 256;
  constexpr std::size_t count = std::size_t{64} * groups;
  const Kernel kernel(gpu, "features_subgroups.comp.spv", {storage_type});
  const Buffer sums = result_buffer(gpu, 2 * count);
  bind_buffer(gpu, kernel.set(), 0, storage_type, sums);
  run_once(gpu, [&](const auto& commands) { kernel.record(commands, {groups, 1, 1}); });
  const auto found = read_back<std::array<std::uint32_t, 2>>(gpu, sums, count);
  std::uint64_t right = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t group = i / 64 * 64;
    std::uint32_t expected = 0;
    for (std::size_t k = group; k < group + 64; ++k) {
      if (found[k][0] == found[i][0]) expected += static_cast<std::uint32_t>(k) + 1;
    }
    right += found[i][1] == expected ? 1U : 0U;
  }
  return judged_feature(right, count, fmt::format("subgroups of {}", subgroups.subgroupSize));
}

// Images

Image float_image(const Gpu& gpu, std::uint32_t width, std::uint32_t height,
                  const std::vector<float>& texels) {
  Image image(gpu, vk::ImageType::e2D, vk::Format::eR32Sfloat, {width, height, 1},
              vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst);
  upload(gpu, image, std::as_bytes(std::span(texels)));
  return image;
}

vk::raii::Sampler address_sampler(const Gpu& gpu, vk::SamplerAddressMode mode) {
  return {gpu.device, vk::SamplerCreateInfo{.magFilter = vk::Filter::eNearest,
                                            .minFilter = vk::Filter::eNearest,
                                            .addressModeU = mode,
                                            .addressModeV = mode,
                                            .addressModeW = mode,
                                            .borderColor = vk::BorderColor::eFloatOpaqueWhite}};
}

constexpr std::uint32_t image_edge = 16;
constexpr float border_value = 1;

float texel_value(std::uint32_t x, std::uint32_t y) {
  return 2.0F + static_cast<float>(x + image_edge * y);
}

// Returns the index of the texel that coordinate `at` addresses along one axis. `at` may lie
// outside of the image. Returns `image_edge` for the border.
std::uint32_t addressed(int at, vk::SamplerAddressMode mode) {
  constexpr int size = static_cast<int>(image_edge);
  if (mode == vk::SamplerAddressMode::eClampToBorder) {
    return at < 0 || at >= size ? image_edge : static_cast<std::uint32_t>(at);
  }
  const int period = mode == vk::SamplerAddressMode::eMirroredRepeat ? 2 * size : size;
  const int within = (at % period + period) % period;
  return static_cast<std::uint32_t>(within < size ? within : period - 1 - within);
}

ProbedFeature probe_addressing(const Gpu& gpu, vk::SamplerAddressMode mode) {
  constexpr std::uint32_t side = 4 * image_edge;
  constexpr std::size_t count = std::size_t{side} * side;
  std::vector<float> texels;
  for (std::uint32_t i = 0; i < image_edge * image_edge; ++i)
    texels.push_back(texel_value(i % image_edge, i / image_edge));
  const Image image = float_image(gpu, image_edge, image_edge, texels);
  const vk::raii::Sampler sampler = address_sampler(gpu, mode);
  const Kernel kernel(gpu, "features_sample.comp.spv",
                      {vk::DescriptorType::eCombinedImageSampler, storage_type}, sizeof image_edge);
  const Buffer values = result_buffer(gpu, count);
  bind_texture(gpu, kernel.set(), 0, image, sampler);
  bind_buffer(gpu, kernel.set(), 1, storage_type, values);
  run_once(gpu, [&](const auto& commands) {
    kernel.record(commands, image_edge, {count / 64, 1, 1});
  });
  const auto found = read_back<float>(gpu, values, count);
  const auto expected = [&](std::size_t i) {
    const auto place = [](std::size_t at) {
      return static_cast<int>(at) - static_cast<int>(image_edge);
    };
    const std::uint32_t x = addressed(place(i % side), mode);
    const std::uint32_t y = addressed(place(i / side), mode);
    return x == image_edge || y == image_edge ? border_value : texel_value(x, y);
  };
  return judged_feature(count_right(found, expected), count,
                        "coordinates from -1 to 3 on both axes");
}

ProbedFeature probe_wide_image(const Gpu& gpu) {
  const std::uint32_t width = gpu.properties.limits.maxImageDimension2D / 64 * 64;
  std::vector<float> texels(std::size_t{2} * width);
  std::iota(texels.begin(), texels.end(), 1.0F);
  const Image image = float_image(gpu, width, 2, texels);
  const vk::raii::Sampler sampler = make_sampler(gpu, vk::Filter::eNearest);
  const Kernel kernel(gpu, "features_fetch.comp.spv",
                      {vk::DescriptorType::eCombinedImageSampler, storage_type});
  const Buffer values = result_buffer(gpu, width);
  bind_texture(gpu, kernel.set(), 0, image, sampler);
  bind_buffer(gpu, kernel.set(), 1, storage_type, values);
  run_once(gpu, [&](const auto& commands) { kernel.record(commands, {width / 64, 1, 1}); });
  const auto found = read_back<float>(gpu, values, width);
  return judged_feature(count_right(found, [&](std::size_t i) { return texels[width + i]; }), width,
                        fmt::format("{} x 2 texels", width));
}

}  // namespace

std::vector<measure::FeatureProbe> feature_probes(const Gpu& gpu) {
  using enum vk::SamplerAddressMode;
  constexpr std::uint64_t gibibyte = std::uint64_t{1} << 30U;
  const auto probe = [&gpu](std::string name, auto run) {
    return measure::FeatureProbe{.name = std::move(name), .run = [&gpu, run] {
                                   return translated([&] { return run(gpu); });
                                 }};
  };
  return {
      probe("work-groups", probe_groups),
      probe("push-constants", probe_push_constants),
      probe("dynamic-offsets", probe_dynamic_offsets),
      probe("offset-2-gib", [](const Gpu& on) { return probe_offset(on, 2 * gibibyte); }),
      probe("offset-4-gib", [](const Gpu& on) { return probe_offset(on, 4 * gibibyte); }),
      probe("subgroups", probe_subgroups),
      probe("repeat", [](const Gpu& on) { return probe_addressing(on, eRepeat); }),
      probe("mirrored-repeat", [](const Gpu& on) { return probe_addressing(on, eMirroredRepeat); }),
      probe("border", [](const Gpu& on) { return probe_addressing(on, eClampToBorder); }),
      probe("wide-image", probe_wide_image),
      probe("indirect-draws", probe_indirect_draws),
      probe("instances", probe_instances),
      probe("base-vertex", probe_base_vertex)};
}

}  // namespace triptych::vulkan_backend
