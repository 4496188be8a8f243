// Driver faults in the execution of commands: draws, dispatches, copies and clears.
#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "tests/layer/chain.hpp"

namespace triptych::layer {
namespace {

// Draws one instance too few or, if there is only one instance, one vertex too few.
VKAPI_ATTR void VKAPI_CALL short_draw(VkCommandBuffer commands, std::uint32_t vertices,
                                      std::uint32_t instances, std::uint32_t first_vertex,
                                      std::uint32_t first_instance) {
  std::uint32_t& last = instances > 1 ? instances : vertices;
  --last;
  next<PFN_vkCmdDraw>(commands, "vkCmdDraw")(commands, vertices, instances, first_vertex,
                                             first_instance);
}

VKAPI_ATTR void VKAPI_CALL short_indirect(VkCommandBuffer commands, VkBuffer buffer,
                                          VkDeviceSize offset, std::uint32_t count,
                                          std::uint32_t stride) {
  next<PFN_vkCmdDrawIndirect>(commands, "vkCmdDrawIndirect")(commands, buffer, offset, count - 1,
                                                             stride);
}

VKAPI_ATTR void VKAPI_CALL short_dispatch(VkCommandBuffer commands, std::uint32_t x,
                                          std::uint32_t y, std::uint32_t z) {
  next<PFN_vkCmdDispatch>(commands, "vkCmdDispatch")(commands, std::max(x, 2U) - 1, y, z);
}

VKAPI_ATTR void VKAPI_CALL short_scissor(VkCommandBuffer commands, std::uint32_t first,
                                         std::uint32_t count, const VkRect2D* scissors) {
  std::vector<VkRect2D> changed(scissors, scissors + count);
  for (VkRect2D& each : changed) --each.extent.width;
  next<PFN_vkCmdSetScissor>(commands, "vkCmdSetScissor")(commands, first, count, changed.data());
}

VKAPI_ATTR void VKAPI_CALL push_off_by_one(VkCommandBuffer commands, VkPipelineLayout layout,
                                           VkShaderStageFlags stages, std::uint32_t offset,
                                           std::uint32_t size, const void* values) {
  std::vector<std::uint32_t> words(size / sizeof(std::uint32_t));
  std::memcpy(words.data(), values, size);
  ++words.front();
  next<PFN_vkCmdPushConstants>(commands, "vkCmdPushConstants")(commands, layout, stages, offset,
                                                               size, words.data());
}

template <auto Spoil>
VKAPI_ATTR void VKAPI_CALL begin_pass(VkCommandBuffer commands, const VkRenderPassBeginInfo* info,
                                      VkSubpassContents contents) {
  std::vector<VkClearValue> values(info->pClearValues, info->pClearValues + info->clearValueCount);
  Spoil(values);
  VkRenderPassBeginInfo changed = *info;
  changed.pClearValues = values.data();
  next<PFN_vkCmdBeginRenderPass>(commands, "vkCmdBeginRenderPass")(commands, &changed, contents);
}

void clear_colour(std::vector<VkClearValue>& values) {
  if (!values.empty()) values.front().color.float32[0] += 0.25F;
}

void clear_depth(std::vector<VkClearValue>& values) {
  if (values.size() > 1) values.back().depthStencil.depth = 0.5F;
}

// Omits the last 64 bytes of a copy.
VKAPI_ATTR void VKAPI_CALL short_copy(VkCommandBuffer commands, VkBuffer from, VkBuffer to,
                                      std::uint32_t count, const VkBufferCopy* regions) {
  std::vector<VkBufferCopy> changed(regions, regions + count);
  for (VkBufferCopy& each : changed) {
    constexpr VkDeviceSize lost = 64;
    if (each.size > lost) each.size -= lost;
  }
  next<PFN_vkCmdCopyBuffer>(commands, "vkCmdCopyBuffer")(commands, from, to, count, changed.data());
}

// Copies each row of the image from the row below it.
VKAPI_ATTR void VKAPI_CALL image_row(VkCommandBuffer commands, VkImage image, VkImageLayout layout,
                                     VkBuffer buffer, std::uint32_t count,
                                     const VkBufferImageCopy* regions) {
  std::vector<VkBufferImageCopy> changed(regions, regions + count);
  for (VkBufferImageCopy& each : changed) {
    if (each.imageExtent.height < 2) continue;
    ++each.imageOffset.y;
    --each.imageExtent.height;
  }
  next<PFN_vkCmdCopyImageToBuffer>(commands, "vkCmdCopyImageToBuffer")(
      commands, image, layout, buffer, count, changed.data());
}

// Replaces the second slice of a volume by a copy of the first slice.
VKAPI_ATTR void VKAPI_CALL volume_slice(VkCommandBuffer commands, VkBuffer buffer, VkImage image,
                                        VkImageLayout layout, std::uint32_t count,
                                        const VkBufferImageCopy* regions) {
  std::vector<VkBufferImageCopy> changed(regions, regions + count);
  for (VkBufferImageCopy& each : changed) {
    if (each.imageExtent.depth < 2) continue;
    ++each.imageOffset.z;
    --each.imageExtent.depth;
  }
  next<PFN_vkCmdCopyBufferToImage>(commands, "vkCmdCopyBufferToImage")(
      commands, buffer, image, layout, count, changed.data());
}

}  // namespace

std::span<const Hook> command_fault_hooks() {
  static const std::array hooks{
      hook("short_draw", "vkCmdDraw", &short_draw),
      hook("short_indirect", "vkCmdDrawIndirect", &short_indirect),
      hook("short_dispatch", "vkCmdDispatch", &short_dispatch),
      hook("short_scissor", "vkCmdSetScissor", &short_scissor),
      hook("push_off_by_one", "vkCmdPushConstants", &push_off_by_one),
      hook("clear_colour", "vkCmdBeginRenderPass", &begin_pass<&clear_colour>),
      hook("clear_depth", "vkCmdBeginRenderPass", &begin_pass<&clear_depth>),
      hook("short_copy", "vkCmdCopyBuffer", &short_copy),
      hook("image_row", "vkCmdCopyImageToBuffer", &image_row),
      hook("volume_slice", "vkCmdCopyBufferToImage", &volume_slice)};
  return hooks;
}

}  // namespace triptych::layer
