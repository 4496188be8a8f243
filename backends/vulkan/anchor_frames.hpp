#pragma once
// Frames of the anchors that compute: launches of one pipeline over words of storage.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backends/vulkan/frames.hpp"
#include "backends/vulkan/instance.hpp"
#include "backends/vulkan/pipeline.hpp"
#include "measure/backend.hpp"
#include "technique/anchors/anchor_work.hpp"

namespace triptych::vulkan_backend {

// Why this device cannot do this anchor at this size.
[[nodiscard]] std::optional<std::string> anchor_reason(const Gpu& gpu,
                                                       const measure::AnchorWork& work,
                                                       const std::string& technique);

class AnchorFrames final : public measure::Prepared {
 public:
  // The device code is "TECHNIQUE.comp.spv".
  AnchorFrames(const Gpu& gpu, const Instance& instance, std::string_view technique,
               const measure::AnchorWork& work);

  // Counting, it first clears the results, so that what is summed was made by this frame.
  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override { return {}; }
  [[nodiscard]] std::string kernel_hash() const override;

 private:
  [[nodiscard]] vk::DescriptorSet make_set() const;
  void record_launches(const vk::raii::CommandBuffer& commands) const;

  const Gpu& gpu_;
  const Instance& instance_;
  std::string code_;  // its file name
  technique::AnchorFrame shape_;
  Buffer parameters_;
  Buffer results_;
  std::optional<Buffer> source_;
  std::optional<Image> volume_;
  vk::raii::Sampler sampler_;
  Layout layout_;
  vk::raii::DescriptorPool pool_;
  vk::DescriptorSet set_;
  vk::Pipeline pipeline_;
  Frames frames_;
};

}  // namespace triptych::vulkan_backend
