#include "backends/vulkan/particle_data.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "measure/contract/not_drawn.hpp"
#include "technique/particles/margins.hpp"
#include "technique/particles/particle_counts.hpp"
#include "technique/particles/particle_parameters.hpp"

namespace triptych::vulkan_backend {
namespace {

using enum vk::BufferUsageFlagBits;

Buffer upload_parameters(const Gpu& gpu, const measure::ParticleWork& work,
                         const technique::Arrangement& arrangement) {
  const technique::ParticleParameters parameters =
      technique::particle_parameters(work.scene, work.options, arrangement);
  return make_buffer(gpu, std::as_bytes(std::span(&parameters, 1)), eUniformBuffer);
}

Buffer upload_property(const Gpu& gpu, const technique::Arrangement& arrangement,
                       technique::Property property) {
  const Fill fill = [&](std::size_t begin, std::span<std::byte> out) {
    arrangement.copy(property, begin, out);
  };
  return make_buffer(gpu, arrangement.bytes(property), fill,
                     eVertexBuffer | eStorageBuffer | eUniformTexelBuffer);
}

double sprite_growth(const Gpu& gpu) {
  return technique::sprite_growth(static_cast<int>(gpu.properties.limits.subPixelPrecisionBits));
}

}  // namespace

float point_margin(const Gpu& gpu) {
  const auto granularity = static_cast<double>(gpu.properties.limits.pointSizeGranularity);
  return static_cast<float>(technique::point_margin(gpu.properties.deviceName.data(), granularity) +
                            2 * sprite_growth(gpu));
}

float largest_point(const Gpu& gpu) {
  const float most =
      gpu.features.largePoints == VK_TRUE ? gpu.properties.limits.pointSizeRange[1] : 1.0F;
  return most - point_margin(gpu);
}

ParticleConstants particle_constants(const Gpu& gpu, const measure::ParticleWork& work) {
  using technique::ComputedAt;
  return {.colour = static_cast<std::int32_t>(work.scene.particles->colour),
          .transfer_at_pixel = work.options.transfer == ComputedAt::pixel ? 1 : 0,
          .ray_at_vertex = work.options.ray == ComputedAt::vertex ? 1 : 0,
          .fault = static_cast<std::int32_t>(work.options.fault),
          .largest_point = largest_point(gpu),
          .point_margin = point_margin(gpu),
          .sprite_growth = static_cast<float>(sprite_growth(gpu))};
}

vk::Format colour_format(scene::ColourKind kind) {
  switch (kind) {
    case scene::ColourKind::rgba8:
      return vk::Format::eR8G8B8A8Unorm;
    case scene::ColourKind::rgba32:
      return vk::Format::eR32G32B32A32Sfloat;
    case scene::ColourKind::intensity:
      return vk::Format::eR32Sfloat;
  }
  return vk::Format::eUndefined;
}

std::uint32_t colour_bytes(scene::ColourKind kind) {
  return kind == scene::ColourKind::rgba32 ? 16 : 4;
}

vk::DescriptorSetLayoutBinding storage_binding(std::uint32_t number, vk::ShaderStageFlags stages) {
  return {.binding = number,
          .descriptorType = vk::DescriptorType::eStorageBuffer,
          .descriptorCount = 1,
          .stageFlags = stages};
}

std::vector<vk::DescriptorSetLayoutBinding> particle_bindings() {
  using Stage = vk::ShaderStageFlagBits;
  constexpr vk::ShaderStageFlags drawing = vk::ShaderStageFlagBits::eAllGraphics;
  constexpr vk::ShaderStageFlags every = drawing | Stage::eCompute;
  const auto uniform = [](std::uint32_t number) {
    return vk::DescriptorSetLayoutBinding{.binding = number,
                                          .descriptorType = vk::DescriptorType::eUniformBuffer,
                                          .descriptorCount = 1,
                                          .stageFlags = every};
  };
  return {uniform(particle_parameters_binding),
          uniform(particle_transfer_binding),
          storage_binding(particle_counters_binding, every),
          storage_binding(spheres_binding, Stage::eVertex | Stage::eCompute),
          storage_binding(colours_binding, Stage::eVertex | Stage::eCompute),
          storage_binding(ids_binding, Stage::eVertex | Stage::eCompute),
          storage_binding(cells_binding, Stage::eCompute)};
}

ParticleData::ParticleData(const Gpu& gpu, const measure::ParticleWork& work,
                           const technique::Arrangement& arrangement)
    : gpu_(gpu),
      particles_(static_cast<std::uint32_t>(arrangement.count())),
      cells_(static_cast<std::uint32_t>(arrangement.cells.size())),
      parameters_(upload_parameters(gpu, work, arrangement)),
      transfer_(make_buffer(gpu, std::as_bytes(std::span(work.scene.intensity_colours.entries)),
                            eUniformBuffer)),
      counters_(gpu, technique::particle_counter_bytes,
                eStorageBuffer | eTransferSrc | eTransferDst, Place::device),
      spheres_(upload_property(gpu, arrangement, technique::Property::sphere)),
      colours_(upload_property(gpu, arrangement, technique::Property::colour)),
      ids_(upload_property(gpu, arrangement, technique::Property::id)),
      cell_boxes_(make_buffer(gpu, std::as_bytes(std::span(arrangement.cells)), eStorageBuffer)) {}

void ParticleData::bind(vk::DescriptorSet set, Fetch fetch) const {
  bind_buffer(gpu_, set, particle_parameters_binding, vk::DescriptorType::eUniformBuffer,
              parameters_);
  bind_buffer(gpu_, set, particle_transfer_binding, vk::DescriptorType::eUniformBuffer, transfer_);
  const auto storage = [&](std::uint32_t binding, const Buffer& buffer) {
    bind_buffer(gpu_, set, binding, vk::DescriptorType::eStorageBuffer, buffer);
  };
  storage(particle_counters_binding, counters_);
  storage(cells_binding, cell_boxes_);
  if (fetch == Fetch::attributes) return;
  storage(spheres_binding, spheres_);
  storage(colours_binding, colours_);
  storage(ids_binding, ids_);
}

void ParticleData::upload_camera(const measure::ParticleWork& work) const {
  const technique::ParticleParameters parameters =
      technique::particle_parameters(work.scene, work.options, particles_, cells_);
  upload(gpu_, parameters_, std::as_bytes(std::span(&parameters, 1)));
}

void ParticleData::poison_counters() const {
  mark_unwritten(gpu_, counters_);
}

void ParticleData::clear_counters(const vk::raii::CommandBuffer& commands) const {
  commands.fillBuffer(counters_.get(), 0, VK_WHOLE_SIZE, 0);
  barrier(commands);
}

record::Counts ParticleData::counts(technique::Method method, technique::Culling culling,
                                    const core::Image& image) const {
  std::vector<std::uint32_t> sums(technique::particle_counter_bytes / sizeof(std::uint32_t));
  download(gpu_, counters_, std::as_writable_bytes(std::span(sums)));
  measure::check_counted(sums);
  return technique::particle_counts(
      {.method = method, .culling = culling, .cells = cells_, .particles = particles_}, sums,
      image);
}

}  // namespace triptych::vulkan_backend
