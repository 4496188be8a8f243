#include "backends/vulkan/volume_resources.hpp"

#include <fmt/format.h>

#include <array>
#include <span>
#include <vector>

#include "measure/contract/not_drawn.hpp"
#include "technique/volume/long_rays.hpp"
#include "technique/volume/opacity_form.hpp"
#include "technique/volume/packed_cells.hpp"
#include "technique/volume/preintegration.hpp"
#include "technique/volume/quadrature_table.hpp"
#include "technique/volume/raycast_buffers.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::uint32_t pass_count = 2;
constexpr std::uint32_t storage_buffers = 5;  // bricks, output, counters, quadrature, paused rays
constexpr std::uint32_t texel_buffers = 4;    // cells, table, bricks, quadrature
// The usage flags that allow shaders to read bricks and the quadrature either as storage buffers or
// as texels.
constexpr auto shader_buffer =
    vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eUniformTexelBuffer;

Buffer upload_quadrature(const Gpu& gpu, const scene::VolumeScene& scene) {
  const technique::QuadratureTable table = technique::quadrature_table(scene);
  return make_buffer(gpu, std::as_bytes(std::span(table)), shader_buffer);
}

Image upload_table(const Gpu& gpu, const scene::TransferFunction& function) {
  Image image(gpu, vk::ImageType::e1D, vk::Format::eR32G32B32A32Sfloat,
              {static_cast<std::uint32_t>(function.entries.size()), 1, 1},
              vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst);
  upload(gpu, image, std::as_bytes(std::span(function.entries)));
  return image;
}

// Creates a buffer for packed cells, each of which stores the eight voxels around a position
// (packed_cells.hpp). If `stored_cells` is 0, the buffer contains the cells of the whole volume.
// Otherwise, it has space for `stored_cells` layers of cells along z, which the host writes before
// they are read.
Buffer make_cells(const Gpu& gpu, const measure::VolumeWork& work, int stored_cells) {
  const scene::VoxelGrid& grid = *work.scene.grid;
  constexpr auto usage = vk::BufferUsageFlagBits::eUniformTexelBuffer;
  if (stored_cells > 0) {
    return {gpu, technique::layers_of(work.scene, work.options).bytes_of(stored_cells),
            usage | vk::BufferUsageFlagBits::eTransferDst, Place::device};
  }
  return make_buffer(
      gpu, technique::packed_bytes(grid.size, grid.format),
      [&](std::size_t begin, std::span<std::byte> out) {
        technique::fill_packed_cells(grid, begin, out);
      },
      usage);
}

Image volume_image(const Gpu& gpu, const scene::VoxelGrid& grid, int slices) {
  return {
      gpu, vk::ImageType::e3D, texture_format(grid.format),
      vk::Extent3D{static_cast<std::uint32_t>(grid.size[0]),
                   static_cast<std::uint32_t>(grid.size[1]), static_cast<std::uint32_t>(slices)},
      vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst};
}

std::vector<vk::DescriptorSetLayoutBinding> volume_bindings(bool packed, bool in_parts) {
  using enum vk::DescriptorType;
  const vk::DescriptorType texture = packed ? eUniformTexelBuffer : eCombinedImageSampler;
  const vk::DescriptorType buffer = packed ? eUniformTexelBuffer : eStorageBuffer;
  constexpr auto stages = vk::ShaderStageFlagBits::eCompute | vk::ShaderStageFlagBits::eFragment;
  const auto binding = [&](Binding number, vk::DescriptorType type) {
    return vk::DescriptorSetLayoutBinding{
        .binding = number, .descriptorType = type, .descriptorCount = 1, .stageFlags = stages};
  };
  std::vector bindings{
      binding(parameters_binding, eUniformBuffer), binding(volume_binding, texture),
      binding(transfer_binding, texture),          binding(bricks_binding, buffer),
      binding(output_binding, eStorageBuffer),     binding(counters_binding, eStorageBuffer),
      binding(quadrature_binding, buffer)};
  if (in_parts) bindings.push_back(binding(pauses_binding, eStorageBuffer));
  return bindings;
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
    case scene::VoxelFormat::f16:
      return vk::Format::eR16Sfloat;
  }
  return vk::Format::eUndefined;
}

Image upload_volume(const Gpu& gpu, const scene::VoxelGrid& grid) {
  Image image = volume_image(gpu, grid, grid.size[2]);
  upload(gpu, image, grid.data);
  return image;
}

VolumeResources::VolumeResources(const Gpu& gpu, const measure::VolumeWork& work,
                                 const Buffer* output, std::span<const std::int32_t> map)
    : VolumeResources(gpu, work, output, map,
                      output != nullptr ? cut_of(gpu, "raycast", work).parts
                                        : std::vector<technique::Part>{}) {}

VolumeResources::VolumeResources(const Gpu& gpu, const measure::VolumeWork& work,
                                 const Buffer* output, std::span<const std::int32_t> map,
                                 const std::vector<technique::Part>& parts)
    : gpu_(gpu),
      pixels_(pixel_count(work.scene)),
      output_(output),
      bricks_(make_buffer(gpu, std::as_bytes(map), shader_buffer)),
      quadrature_(upload_quadrature(gpu, work.scene)),
      parameters_(make_parameters(work, map, parts)),
      layout_(make_layout(gpu, volume_bindings(is_packed(work), !parts.empty()))),
      pool_(make_pool(gpu, pass_count, storage_buffers, is_packed(work) ? texel_buffers : 0)),
      sets_(allocate_sets(gpu, pool_, layout_, pass_count)) {
  const int stored_cells = technique::most_stored_cells(parts);
  if (is_packed(work)) {
    texels_.emplace(make_texels(work, stored_cells));
  } else {
    images_.emplace(make_images(work, stored_cells));
  }
  if (parts_) {
    pauses_.emplace(gpu, technique::pauses_bytes(work.scene, work.options),
                    vk::BufferUsageFlagBits::eStorageBuffer, Place::device);
  }
  write_set(Pass::timed);
  write_set(Pass::counting);
}

// Creates the parameter buffer. For a volume in parts, it has space for a part's parameters at the
// end.
Buffer VolumeResources::make_parameters(const measure::VolumeWork& work,
                                        std::span<const std::int32_t> map,
                                        const std::vector<technique::Part>& parts) {
  // The shader reads the texels of an image divided by the largest value that the format can store.
  const double stored_maximum =
      is_packed(work) ? 1 : scene::largest_stored(work.scene.grid->format);
  std::vector<std::byte> parameters =
      technique::raycast_parameters(work.scene, work.options, stored_maximum);
  if (!parts.empty()) {
    parameters.resize(parameters.size() + sizeof(technique::PartParameters));
    parts_.emplace(gpu_, work, parts, map, parameters);
  }
  return make_buffer(gpu_, parameters, vk::BufferUsageFlagBits::eUniformBuffer);
}

VolumeResources::Images VolumeResources::make_images(const measure::VolumeWork& work,
                                                     int stored_cells) const {
  const scene::VoxelGrid& grid = *work.scene.grid;
  const bool linear = work.options.sampler == technique::Sampler::hardware;
  return {.volume = stored_cells > 0 ? volume_image(gpu_, grid, stored_cells + 1)
                                     : upload_volume(gpu_, grid),
          .table = upload_table(gpu_, work.scene.transfer_function),
          .volume_sampler = make_sampler(gpu_, linear ? vk::Filter::eLinear : vk::Filter::eNearest),
          .nearest = make_sampler(gpu_, vk::Filter::eNearest)};
}

VolumeResources::Texels VolumeResources::make_texels(const measure::VolumeWork& work,
                                                     int stored_cells) const {
  const scene::VoxelGrid& grid = *work.scene.grid;
  Buffer cells = make_cells(gpu_, work, stored_cells);
  Buffer table = make_buffer(gpu_, std::as_bytes(std::span(work.scene.transfer_function.entries)),
                             vk::BufferUsageFlagBits::eUniformTexelBuffer);
  const vk::Format cell = technique::packed_texel_bytes(grid.format) == 8
                              ? vk::Format::eR32G32Uint
                              : vk::Format::eR32G32B32A32Uint;
  vk::raii::BufferView cells_view = texel_view(gpu_, cells, cell);
  vk::raii::BufferView table_view = texel_view(gpu_, table, vk::Format::eR32G32B32A32Sfloat);
  return {.cells = std::move(cells),
          .table = std::move(table),
          .cells_view = std::move(cells_view),
          .table_view = std::move(table_view),
          .bricks_view = texel_view(gpu_, bricks_, vk::Format::eR32Sint),
          .quadrature_view = texel_view(gpu_, quadrature_, vk::Format::eR32G32B32A32Sfloat)};
}

void VolumeResources::move_part(int n) {
  parts_->move(n, parameters_, images_ ? &images_->volume : nullptr,
               texels_ ? &texels_->cells : nullptr);
}

void VolumeResources::write_set(Pass pass) const {
  using enum vk::DescriptorType;
  const vk::DescriptorSet to = set(pass);
  bind_buffer(gpu_, to, parameters_binding, eUniformBuffer, parameters_);
  if (texels_) {
    bind_texels(gpu_, to, volume_binding, texels_->cells_view);
    bind_texels(gpu_, to, transfer_binding, texels_->table_view);
    bind_texels(gpu_, to, bricks_binding, texels_->bricks_view);
    bind_texels(gpu_, to, quadrature_binding, texels_->quadrature_view);
  } else {
    bind_texture(gpu_, to, volume_binding, images_->volume, images_->volume_sampler);
    bind_texture(gpu_, to, transfer_binding, images_->table, images_->nearest);
    bind_buffer(gpu_, to, bricks_binding, eStorageBuffer, bricks_);
    bind_buffer(gpu_, to, quadrature_binding, eStorageBuffer, quadrature_);
  }
  if (output_ != nullptr) bind_buffer(gpu_, to, output_binding, eStorageBuffer, *output_);
  if (pauses_) bind_buffer(gpu_, to, pauses_binding, eStorageBuffer, *pauses_);
}

vk::DescriptorSet VolumeResources::set(Pass pass) const {
  return sets_.at(pass == Pass::timed ? 0 : 1);
}

// Counting has its own descriptor set, because a set must not be updated once recorded commands use
// it.
void VolumeResources::bind_counters() {
  make_counters(pixels_ * technique::raycast_counter_stride);
  poison_counters();
}

void VolumeResources::make_counters(std::size_t words) {
  counters_.emplace(gpu_, words * sizeof(std::uint32_t),
                    vk::BufferUsageFlagBits::eStorageBuffer |
                        vk::BufferUsageFlagBits::eTransferSrc |
                        vk::BufferUsageFlagBits::eTransferDst,
                    Place::device);
  bind_buffer(gpu_, set(Pass::counting), counters_binding, vk::DescriptorType::eStorageBuffer,
              *counters_);
}

void VolumeResources::bind_trace(int x, int y, int width) {
  const std::vector<std::uint32_t> words = technique::ray_trace_words_for(x, y, width, pixels_);
  make_counters(words.size());
  upload(gpu_, *counters_, std::as_bytes(std::span(words)));
}

technique::RayTrace VolumeResources::read_trace() const {
  std::vector<std::uint32_t> words(pixels_ * technique::raycast_counter_stride +
                                   technique::ray_trace_words);
  download(gpu_, counters_.value(), std::as_writable_bytes(std::span(words)));
  return technique::read_ray_trace(
      std::span(words).subspan(pixels_ * technique::raycast_counter_stride));
}

void VolumeResources::poison_counters() const {
  if (counters_) mark_unwritten(gpu_, *counters_);
}

record::Counts VolumeResources::read_counters() const {
  constexpr std::size_t stride = technique::raycast_counter_stride;
  std::vector<std::uint32_t> values(pixels_ * stride);
  download(gpu_, counters_.value(), std::as_writable_bytes(std::span(values)));
  measure::check_counted(values);
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
          .adapt = work.options.adapt > 0 ? 1 : 0,
          .voxel_bits = technique::voxel_bits(work.scene.grid->format)};
}

std::string_view raycast_spirv(std::string_view shader, const measure::VolumeWork& work, Pass pass,
                               bool in_parts) {
  if (pass == Pass::tracing && work.scene.quadrature == scene::Quadrature::cells) return {};
  const std::size_t dot = shader.find('.');
  return spirv(fmt::format("{}{}{}{}{}{}{}{}.spv", shader.substr(0, dot),
                           work.scene.quadrature == scene::Quadrature::cells ? "_cells" : "",
                           is_packed(work) ? "_packed" : "",
                           work.options.precision == technique::Precision::fp64 ? "_fp64" : "",
                           technique::has_long_rays(work.scene) ? "_long" : "",
                           in_parts ? "_parts" : "",
                           pass == Pass::counting  ? "_counting"
                           : pass == Pass::tracing ? "_tracing"
                                                   : "",
                           shader.substr(dot)));
}

}  // namespace triptych::vulkan_backend
