#pragma once
// Buffers and images that own their memory, and data transfer to and from them.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "backends/vulkan/gpu.hpp"

namespace triptych::vulkan_backend {

enum class Place : std::uint8_t {
  device,    // device memory, preferred for speed
  upload,    // written by the host, mapped
  read_back  // read by the host, mapped, in cached memory if available
};

// A VkBuffer with its VkDeviceMemory.
class Buffer {
 public:
  // Throws core::NotSupported if the device does not have enough memory, and core::ApiError.
  Buffer(const Gpu& gpu, vk::DeviceSize size, vk::BufferUsageFlags usage, Place place,
         core::CodePlace code_place = core::CodePlace::current());

  [[nodiscard]] vk::Buffer get() const noexcept { return *buffer_; }
  [[nodiscard]] vk::DeviceSize size() const noexcept { return size_; }
  // Returns the contents of the whole buffer; empty for Place::device.
  [[nodiscard]] std::span<std::byte> mapped() const noexcept { return mapped_; }

 private:
  vk::DeviceSize size_;
  vk::raii::DeviceMemory memory_;
  vk::raii::Buffer buffer_;
  std::span<std::byte> mapped_;
  measure::MemoryLedger::Entry ledger_entry_;
};

// A VkImage with one mip level and one layer in device memory, and its VkImageView.
class Image {
 public:
  Image(const Gpu& gpu, vk::ImageType type, vk::Format format, vk::Extent3D extent,
        vk::ImageUsageFlags usage, vk::ImageAspectFlagBits aspect = vk::ImageAspectFlagBits::eColor,
        core::CodePlace code_place = core::CodePlace::current());

  [[nodiscard]] vk::Image get() const noexcept { return *image_; }
  [[nodiscard]] vk::ImageView view() const noexcept { return *view_; }
  [[nodiscard]] vk::Extent3D extent() const noexcept { return extent_; }
  [[nodiscard]] vk::ImageSubresourceRange whole() const noexcept {
    return {.aspectMask = aspect_, .levelCount = 1, .layerCount = 1};
  }
  [[nodiscard]] vk::ImageSubresourceLayers layer() const noexcept {
    return {.aspectMask = aspect_, .layerCount = 1};
  }

 private:
  vk::Extent3D extent_;
  vk::ImageAspectFlagBits aspect_;
  vk::raii::DeviceMemory memory_;
  vk::raii::Image image_;
  vk::raii::ImageView view_;
  measure::MemoryLedger::Entry ledger_entry_;
};

// Changes the layout of the image. The change waits for all earlier writes.
void change_layout(const vk::raii::CommandBuffer& commands, const Image& image,
                   vk::ImageLayout from, vk::ImageLayout to);

// Writes the part of a buffer that begins at byte `begin`.
using Fill = std::function<void(std::size_t begin, std::span<std::byte> out)>;

// Creates a buffer of `size` bytes in device memory, or of a few bytes if `size` is 0, because
// buffers must not be empty. Fills it through a small staging buffer, part by part, in multiples of
// 16 bytes. `fill` writes directly to the staging buffer, so that the host needs no other copy of
// the data.
[[nodiscard]] Buffer make_buffer(const Gpu& gpu, std::size_t size, const Fill& fill,
                                 vk::BufferUsageFlags usage);

// Creates a buffer in device memory from bytes that exist in host memory.
[[nodiscard]] Buffer make_buffer(const Gpu& gpu, std::span<const std::byte> bytes,
                                 vk::BufferUsageFlags usage);

// Fills an image, x fastest, and leaves it in eShaderReadOnlyOptimal. Uses a small staging buffer
// for one slice at a time, so that the device never stores a second copy.
void upload(const Gpu& gpu, const Image& image, std::span<const std::byte> texels);
// Fills only the first slices of an image. The content of the other slices is undefined.
void upload(const Gpu& gpu, const Image& image, std::span<const std::byte> texels,
            std::uint32_t slices);

// Writes the first bytes of a buffer that make_buffer created, through a small staging buffer.
void upload(const Gpu& gpu, const Buffer& to, std::size_t size, const Fill& fill);

// Writes the first bytes of a buffer that make_buffer created.
void upload(const Gpu& gpu, const Buffer& to, std::span<const std::byte> bytes);

// Fills a buffer with usage eTransferDst with a value that no image and no count contains: NaN as a
// float, 2³²−1 as an integer. Newly allocated memory may contain correct results of an earlier
// frame.
void mark_unwritten(const Gpu& gpu, const Buffer& buffer);

// Copies the first bytes of the buffer to the host. Bytes that the device fails to copy keep the
// value that marks unwritten memory.
void download(const Gpu& gpu, const Buffer& from, std::span<std::byte> to);

// Copies an image in eTransferSrcOptimal to the host, x fastest.
void download(const Gpu& gpu, const Image& from, std::span<std::byte> to);

}  // namespace triptych::vulkan_backend
