#include "backends/vulkan/volume_resources.hpp"

#include <fmt/format.h>

#include <array>
#include <span>
#include <vector>

#include "technique/volume/brick_map.hpp"
#include "technique/volume/long_rays.hpp"
#include "technique/volume/opacity_form.hpp"
#include "technique/volume/preintegration.hpp"
#include "technique/volume/quadrature_table.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::uint32_t passes = 2;
constexpr std::uint32_t storage_buffers = 4;  // bricks, output, counters, quadrature

Buffer upload_parameters(const Gpu& gpu, const measure::VolumeWork& work) {
  // A texel reaches the shader divided by its format's largest.
  const double stored_maximum = scene::largest_stored(work.scene.grid->format);
  return make_buffer(gpu, technique::raycast_parameters(work.scene, work.options, stored_maximum),
                     vk::BufferUsageFlagBits::eUniformBuffer);
}

Buffer upload_bricks(const Gpu& gpu, const measure::VolumeWork& work) {
  // Read by nothing when nothing is skipped.
  const std::vector<std::int32_t> map =
      technique::brick_map(work.scene, work.options.skip, work.options.adapt);
  return make_buffer(gpu, std::as_bytes(std::span(map)), vk::BufferUsageFlagBits::eStorageBuffer);
}

Buffer upload_quadrature(const Gpu& gpu, const scene::VolumeScene& scene) {
  const technique::QuadratureTable table = technique::quadrature_table(scene);
  return make_buffer(gpu, std::as_bytes(std::span(table)), vk::BufferUsageFlagBits::eStorageBuffer);
}

Image upload_table(const Gpu& gpu, const scene::TransferFunction& function) {
  Image image(gpu, vk::ImageType::e1D, vk::Format::eR32G32B32A32Sfloat,
              {static_cast<std::uint32_t>(function.entries.size()), 1, 1},
              vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst);
  upload(gpu, image, std::as_bytes(std::span(function.entries)));
  return image;
}

std::array<vk::DescriptorSetLayoutBinding, 7> volume_bindings() {
  using enum vk::DescriptorType;
  constexpr auto stages = vk::ShaderStageFlagBits::eCompute | vk::ShaderStageFlagBits::eFragment;
  const auto binding = [&](Binding number, vk::DescriptorType type) {
    return vk::DescriptorSetLayoutBinding{
        .binding = number, .descriptorType = type, .descriptorCount = 1, .stageFlags = stages};
  };
  return {binding(parameters_binding, eUniformBuffer),
          binding(volume_binding, eCombinedImageSampler),
          binding(transfer_binding, eCombinedImageSampler),
          binding(bricks_binding, eStorageBuffer),
          binding(output_binding, eStorageBuffer),
          binding(counters_binding, eStorageBuffer),
          binding(quadrature_binding, eStorageBuffer)};
}

std::size_t pixel_count(const scene::VolumeScene& scene) {
  return static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
}

}  // namespace

vk::Format texture_format(scene::VoxelFormat format) {
  switch (format) {
    case scene::VoxelFormat::u8:
      return vk::Format::eR8Unorm;
    case scene::VoxelFormat::u16:
      return vk::Format::eR16Unorm;
    case scene::VoxelFormat::f32:
      return vk::Format::eR32Sfloat;
  }
  return vk::Format::eUndefined;
}

Image upload_volume(const Gpu& gpu, const scene::VoxelGrid& grid) {
  Image image(gpu, vk::ImageType::e3D, texture_format(grid.format),
              {static_cast<std::uint32_t>(grid.size[0]), static_cast<std::uint32_t>(grid.size[1]),
               static_cast<std::uint32_t>(grid.size[2])},
              vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst);
  upload(gpu, image, grid.data);
  return image;
}

VolumeResources::VolumeResources(const Gpu& gpu, const measure::VolumeWork& work,
                                 const Buffer* output)
    : gpu_(gpu),
      pixels_(pixel_count(work.scene)),
      output_(output),
      volume_(upload_volume(gpu, *work.scene.grid)),
      table_(upload_table(gpu, work.scene.transfer_function)),
      bricks_(upload_bricks(gpu, work)),
      quadrature_(upload_quadrature(gpu, work.scene)),
      parameters_(upload_parameters(gpu, work)),
      linear_(make_sampler(gpu, vk::Filter::eLinear)),
      nearest_(make_sampler(gpu, vk::Filter::eNearest)),
      hardware_filter_(work.options.sampler == technique::Sampler::hardware),
      layout_(make_layout(gpu, volume_bindings())),
      pool_(make_pool(gpu, passes, storage_buffers)),
      sets_(allocate_sets(gpu, pool_, layout_, passes)) {
  write_set(Pass::timed);
  write_set(Pass::counting);
}

void VolumeResources::write_set(Pass pass) const {
  using enum vk::DescriptorType;
  const vk::DescriptorSet to = set(pass);
  bind_buffer(gpu_, to, parameters_binding, eUniformBuffer, parameters_);
  bind_texture(gpu_, to, volume_binding, volume_, hardware_filter_ ? linear_ : nearest_);
  bind_texture(gpu_, to, transfer_binding, table_, nearest_);
  bind_buffer(gpu_, to, bricks_binding, eStorageBuffer, bricks_);
  bind_buffer(gpu_, to, quadrature_binding, eStorageBuffer, quadrature_);
  if (output_ != nullptr) bind_buffer(gpu_, to, output_binding, eStorageBuffer, *output_);
}

vk::DescriptorSet VolumeResources::set(Pass pass) const {
  return sets_.at(static_cast<std::size_t>(pass));
}

// A set that recorded commands use must not be written again: hence one of its own for counting.
void VolumeResources::bind_counters() {
  counters_.emplace(gpu_, pixels_ * technique::raycast_counter_stride * sizeof(std::uint32_t),
                    vk::BufferUsageFlagBits::eStorageBuffer |
                        vk::BufferUsageFlagBits::eTransferSrc |
                        vk::BufferUsageFlagBits::eTransferDst,
                    Place::device);
  mark_unwritten(gpu_, *counters_);
  bind_buffer(gpu_, set(Pass::counting), counters_binding, vk::DescriptorType::eStorageBuffer,
              *counters_);
}

record::Counts VolumeResources::read_counters() const {
  constexpr std::size_t stride = technique::raycast_counter_stride;
  std::vector<std::uint32_t> values(pixels_ * stride);
  download(gpu_, counters_.value(), std::as_writable_bytes(std::span(values)));
  std::array<std::uint64_t, technique::raycast_counters.size()> sums{};
  for (std::size_t pixel = 0; pixel < pixels_; ++pixel) {
    for (std::size_t k = 0; k < sums.size(); ++k) sums.at(k) += values[pixel * stride + k];
  }
  record::Counts counts{{"rays", pixels_}};
  for (std::size_t k = 0; k < sums.size(); ++k) {
    counts.emplace(technique::raycast_counters.at(k), sums.at(k));
  }
  return counts;
}

Constants constants_of(const measure::VolumeWork& work) {
  return {.manual_sampler = work.options.sampler == technique::Sampler::manual ? 1 : 0,
          .shading = work.scene.shading.enabled ? 1 : 0,
          .speed_of_light = 0,
          .fault = static_cast<std::int32_t>(work.options.fault),
          .opacity_form = work.options.fault == technique::Fault::uncorrected_opacity
                              ? technique::opacity_form(1)
                              : technique::opacity_form(work.scene.step_voxels),
          .preintegrated = technique::preintegration_form(work.scene),
          .leaps = work.options.skip == technique::Skip::distance ? 1 : 0,
          .adapt = work.options.adapt > 0 ? 1 : 0};
}

std::string_view raycast_spirv(std::string_view shader, const measure::VolumeWork& work,
                               Pass pass) {
  const std::size_t dot = shader.find('.');
  return spirv(fmt::format("{}{}{}{}{}{}.spv", shader.substr(0, dot),
                           work.scene.quadrature == scene::Quadrature::cells ? "_cells" : "",
                           work.options.precision == technique::Precision::fp64 ? "_fp64" : "",
                           technique::has_long_rays(work.scene) ? "_long" : "",
                           pass == Pass::counting ? "_counting" : "", shader.substr(dot)));
}

}  // namespace triptych::vulkan_backend
