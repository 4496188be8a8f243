#include "backends/vulkan/pipelines.hpp"

#include <algorithm>

namespace triptych::vulkan_backend {

vk::Pipeline Pipelines::get(const std::string& key, const StageNames& stages, const Make& make) {
  using enum vk::PipelineCreateFlagBits;
  const vk::PipelineCreateFlags flags =
      captures_ ? eCaptureStatisticsKHR | eCaptureInternalRepresentationsKHR
                : vk::PipelineCreateFlags{};
  // Captured pipelines have keys of their own, because drivers report nothing about a pipeline that
  // was created without the capture flags.
  const std::string full_key = captures_ ? "captured; " + key : key;
  auto found = pipelines_.find(full_key);
  if (found == pipelines_.end()) found = pipelines_.emplace(full_key, make(flags)).first;
  if (captures_) {
    Captured captured{stages, *found->second};
    if (std::ranges::find(captured_, captured) == captured_.end()) {
      captured_.push_back(std::move(captured));
    }
  }
  return *found->second;
}

void Pipelines::start_capture() {
  captures_ = true;
  captured_.clear();
}

std::vector<Pipelines::Captured> Pipelines::end_capture() {
  captures_ = false;
  return std::exchange(captured_, {});
}

}  // namespace triptych::vulkan_backend
