#include "backends/vulkan/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "backends/vulkan/errors.hpp"
#include "core/error.hpp"
#include "measure/contract/dump.hpp"
#include "measure/contract/not_drawn.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::size_t staging_goal = std::size_t{16} << 20;
constexpr std::size_t smallest_buffer = 16;

vk::DeviceSize heap_size(const Gpu& gpu, std::uint32_t type) {
  return gpu.memory.memoryHeaps[gpu.memory.memoryTypes[type].heapIndex].size;
}

// Chooses a memory type. Never uses a heap that is too small, such as a heap of 0 bytes, whatever
// its flags are.
std::uint32_t memory_type(const Gpu& gpu, const vk::MemoryRequirements& needed, Place place) {
  // Without a GPU, RADV lists no memory types, but accepts the index 0.
  if (!gpu.executes) return 0;
  using enum vk::MemoryPropertyFlagBits;
  const vk::MemoryPropertyFlags host = eHostVisible | eHostCoherent;
  // The property flags in order of preference. The specification guarantees that a type with the
  // last flags exists.
  std::array<vk::MemoryPropertyFlags, 2> preferences{};
  if (place == Place::device) preferences = {eDeviceLocal, {}};
  if (place == Place::upload) preferences = {host, host};
  if (place == Place::read_back) preferences = {host | eHostCached, host};
  vk::DeviceSize largest = 0;
  for (const vk::MemoryPropertyFlags preference : preferences) {
    for (std::uint32_t type = 0; type < gpu.memory.memoryTypeCount; ++type) {
      const bool allowed = (needed.memoryTypeBits >> type & 1U) != 0;
      const bool fits = (gpu.memory.memoryTypes[type].propertyFlags & preference) == preference;
      if (!allowed || !fits) continue;
      if (heap_size(gpu, type) >= needed.size) return type;
      largest = std::max(largest, heap_size(gpu, type));
    }
  }
  throw core::NotSupported(
      fmt::format("needs {} bytes of device memory, but the largest heap for this resource has {}",
                  needed.size, largest));
}

vk::raii::DeviceMemory allocate(const Gpu& gpu, const vk::MemoryRequirements& needed, Place place,
                                core::CodePlace code_place, bool addressed = false) {
  const std::uint32_t type = memory_type(gpu, needed, place);
  const vk::MemoryAllocateFlagsInfo flags{.flags = vk::MemoryAllocateFlagBits::eDeviceAddress};
  try {
    return {gpu.device, vk::MemoryAllocateInfo{.pNext = addressed ? &flags : nullptr,
                                               .allocationSize = needed.size,
                                               .memoryTypeIndex = type}};
  } catch (const vk::SystemError& error) {
    // An allocation above this limit may succeed, but devices may also reject it.
    if (needed.size > gpu.most_allocated) {
      throw core::NotSupported(fmt::format(
          "the device rejected an allocation of {} bytes; maxMemoryAllocationSize is {}",
          needed.size, gpu.most_allocated));
    }
    rethrow(error, code_place,
            fmt::format("while allocating {} bytes of memory type {} from a heap of {} bytes",
                        needed.size, type, heap_size(gpu, type)));
  }
}

constexpr std::uint32_t unwritten = measure::poison_word;

// Creates a buffer that receives `size` bytes from the device.
Buffer read_back_buffer(const Gpu& gpu, std::size_t size) {
  Buffer buffer(gpu, size, vk::BufferUsageFlagBits::eTransferDst, Place::read_back);
  std::memset(buffer.mapped().data(), static_cast<int>(unwritten & 0xFFU), size);
  return buffer;
}

// Makes transfer writes visible to the host as soon as the fence of the submission is signalled.
void release_to_host(const vk::raii::CommandBuffer& commands) {
  const vk::MemoryBarrier barrier{.srcAccessMask = vk::AccessFlagBits::eTransferWrite,
                                  .dstAccessMask = vk::AccessFlagBits::eHostRead};
  commands.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost,
                           {}, barrier, {}, {});
}

}  // namespace

void change_layout(const vk::raii::CommandBuffer& commands, const Image& image,
                   vk::ImageLayout from, vk::ImageLayout to) {
  const vk::ImageMemoryBarrier barrier{
      .srcAccessMask = vk::AccessFlagBits::eMemoryWrite,
      .dstAccessMask = vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite,
      .oldLayout = from,
      .newLayout = to,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .image = image.get(),
      .subresourceRange = image.whole()};
  commands.pipelineBarrier(vk::PipelineStageFlagBits::eAllCommands,
                           vk::PipelineStageFlagBits::eAllCommands, {}, {}, {}, barrier);
}

Buffer::Buffer(const Gpu& gpu, vk::DeviceSize size, vk::BufferUsageFlags usage, Place place,
               core::CodePlace code_place)
    : size_(size),
      memory_(nullptr),
      buffer_(translated(
          [&] {
            return vk::raii::Buffer(gpu.device, vk::BufferCreateInfo{.size = size, .usage = usage});
          },
          code_place)) {
  const vk::MemoryRequirements needed = buffer_.getMemoryRequirements();
  memory_ = allocate(gpu, needed, place, code_place,
                     bool(usage & vk::BufferUsageFlagBits::eShaderDeviceAddress));
  ledger_entry_ = gpu.memory_ledger.buffer(needed.size);
  name_object(gpu, vk::ObjectType::eBuffer,
              reinterpret_cast<std::uint64_t>(static_cast<VkBuffer>(*buffer_)), "buffer",
              code_place);
  buffer_.bindMemory(*memory_, 0);
  if (place == Place::device) return;
  mapped_ = {static_cast<std::byte*>(memory_.mapMemory(0, size)), static_cast<std::size_t>(size)};
}

Image::Image(const Gpu& gpu, vk::ImageType type, vk::Format format, vk::Extent3D extent,
             vk::ImageUsageFlags usage, vk::ImageAspectFlagBits aspect, core::CodePlace code_place)
    : extent_(extent),
      aspect_(aspect),
      memory_(nullptr),
      image_(translated(
          [&] {
            // RADV of Mesa 22.3 crashes in vkCreateImage if there is no GPU. Compiling pipelines
            // needs no image.
            if (!gpu.executes) return vk::raii::Image(nullptr);
            return vk::raii::Image(gpu.device, vk::ImageCreateInfo{.imageType = type,
                                                                   .format = format,
                                                                   .extent = extent,
                                                                   .mipLevels = 1,
                                                                   .arrayLayers = 1,
                                                                   .usage = usage});
          },
          code_place)),
      view_(nullptr) {
  if (!gpu.executes) return;
  const vk::MemoryRequirements needed = image_.getMemoryRequirements();
  memory_ = allocate(gpu, needed, Place::device, code_place);
  ledger_entry_ = gpu.memory_ledger.image(needed.size);
  name_object(gpu, vk::ObjectType::eImage,
              reinterpret_cast<std::uint64_t>(static_cast<VkImage>(*image_)), "image", code_place);
  image_.bindMemory(*memory_, 0);
  // The values of vk::ImageType for 1D, 2D and 3D equal those of vk::ImageViewType.
  view_ = {gpu.device, vk::ImageViewCreateInfo{.image = *image_,
                                               .viewType = static_cast<vk::ImageViewType>(type),
                                               .format = format,
                                               .subresourceRange = whole()}};
}

Buffer make_buffer(const Gpu& gpu, std::size_t size, const Fill& fill, vk::BufferUsageFlags usage) {
  Buffer buffer(gpu, std::max(size, smallest_buffer), usage | vk::BufferUsageFlagBits::eTransferDst,
                Place::device);
  upload(gpu, buffer, size, fill);
  return buffer;
}

void upload(const Gpu& gpu, const Buffer& to, std::size_t size, const Fill& fill) {
  if (size == 0) return;
  const Buffer staging(gpu, std::min(size, staging_goal), vk::BufferUsageFlagBits::eTransferSrc,
                       Place::upload);
  const std::span<std::byte> memory = staging.mapped();
  for (std::size_t begin = 0; begin < size; begin += memory.size()) {
    const std::span<std::byte> part = memory.first(std::min(memory.size(), size - begin));
    fill(begin, part);
    if (measure::dump_folder())
      measure::write_dump(
          "buffer", "bin", part,
          fmt::format("bytes {} to {} of a buffer of {} bytes", begin, begin + part.size(), size));
    run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
      commands.copyBuffer(staging.get(), to.get(),
                          vk::BufferCopy{.dstOffset = begin, .size = part.size()});
    });
  }
}

Buffer make_buffer(const Gpu& gpu, std::span<const std::byte> bytes, vk::BufferUsageFlags usage) {
  const Fill copy = [&](std::size_t begin, std::span<std::byte> out) {
    std::ranges::copy(bytes.subspan(begin, out.size()), out.begin());
  };
  return make_buffer(gpu, bytes.size(), copy, usage);
}

void upload(const Gpu& gpu, const Image& image, std::span<const std::byte> texels) {
  upload(gpu, image, texels, image.extent().depth);
}

void upload(const Gpu& gpu, const Image& image, std::span<const std::byte> texels,
            std::uint32_t slices_in_all) {
  const vk::Extent3D extent{image.extent().width, image.extent().height, slices_in_all};
  const std::size_t slice = texels.size() / extent.depth;
  const std::size_t slices = std::clamp<std::size_t>(staging_goal / slice, 1, extent.depth);
  const Buffer staging(gpu, slices * slice, vk::BufferUsageFlagBits::eTransferSrc, Place::upload);
  for (std::size_t z = 0; z < extent.depth; z += slices) {
    const std::size_t count = std::min(slices, extent.depth - z);
    std::ranges::copy(texels.subspan(z * slice, count * slice), staging.mapped().begin());
    if (measure::dump_folder())
      measure::write_dump("image", "bin", texels.subspan(z * slice, count * slice),
                          fmt::format("slices {} to {} of an image of {}x{}x{} texels", z,
                                      z + count, extent.width, extent.height, extent.depth));
    run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
      using enum vk::ImageLayout;
      if (z == 0) change_layout(commands, image, eUndefined, eTransferDstOptimal);
      commands.copyBufferToImage(
          staging.get(), image.get(), eTransferDstOptimal,
          vk::BufferImageCopy{
              .imageSubresource = image.layer(),
              .imageOffset = {.z = static_cast<std::int32_t>(z)},
              .imageExtent = {extent.width, extent.height, static_cast<std::uint32_t>(count)}});
      if (z + count == extent.depth) {
        change_layout(commands, image, eTransferDstOptimal, eShaderReadOnlyOptimal);
      }
    });
  }
}

void upload(const Gpu& gpu, const Buffer& to, std::span<const std::byte> bytes) {
  const Buffer staging(gpu, bytes.size(), vk::BufferUsageFlagBits::eTransferSrc, Place::upload);
  std::ranges::copy(bytes, staging.mapped().begin());
  if (measure::dump_folder())
    measure::write_dump("buffer", "bin", bytes,
                        fmt::format("the first {} bytes of a buffer", bytes.size()));
  run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(staging.get(), to.get(), vk::BufferCopy{.size = bytes.size()});
  });
}

void mark_unwritten(const Gpu& gpu, const Buffer& buffer) {
  run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(buffer.get(), 0, VK_WHOLE_SIZE, unwritten);
  });
}

void download(const Gpu& gpu, const Buffer& from, std::span<std::byte> to) {
  const Buffer staging = read_back_buffer(gpu, to.size());
  run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(from.get(), staging.get(), vk::BufferCopy{.size = to.size()});
    release_to_host(commands);
  });
  std::memcpy(to.data(), staging.mapped().data(), to.size());
}

void download(const Gpu& gpu, const Image& from, std::span<std::byte> to) {
  const Buffer staging = read_back_buffer(gpu, to.size());
  run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
    commands.copyImageToBuffer(
        from.get(), vk::ImageLayout::eTransferSrcOptimal, staging.get(),
        vk::BufferImageCopy{.imageSubresource = from.layer(), .imageExtent = from.extent()});
    release_to_host(commands);
  });
  std::memcpy(to.data(), staging.mapped().data(), to.size());
}

}  // namespace triptych::vulkan_backend
