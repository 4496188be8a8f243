#pragma once
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "backends/vulkan/vulkan.hpp"

namespace triptych::vulkan_backend {

// The shader names of a pipeline by stage, such as "sphere.frag" for the fragment shader.
using StageNames = std::vector<std::pair<vk::ShaderStageFlagBits, std::string>>;

// The pipelines of an open device. Each pipeline is built once, and is used for all work that is
// prepared on the device. A VkPipelineCache would not replace this class, because the driver
// decides what it caches, and lavapipe caches nothing. If all pipelines were built again for every
// work, this would take most of the time that a short frame needs with its preparation.
class Pipelines {
 public:
  // Builds a pipeline with the given flags.
  using Make = std::function<vk::raii::Pipeline(vk::PipelineCreateFlags)>;

  // Returns the pipeline that was created earlier for this key, or otherwise the result of `make`,
  // which then exists as long as the device. The key must contain all properties of the pipeline,
  // including its layout. A pipeline can be used with every layout that has the same definition.
  [[nodiscard]] vk::Pipeline get(const std::string& key, const StageNames& stages,
                                 const Make& make);

  struct Captured {
    StageNames stages;
    vk::Pipeline pipeline;
    bool operator==(const Captured&) const = default;
  };
  // Starts a capture: pipelines are now created in such a way that the driver reports their
  // compiled code, and every requested pipeline is recorded once.
  void start_capture();
  // Ends the capture, and returns the recorded pipelines in the order in which they were requested.
  [[nodiscard]] std::vector<Captured> end_capture();

 private:
  std::map<std::string, vk::raii::Pipeline> pipelines_;
  bool captures_ = false;
  std::vector<Captured> captured_;
};

}  // namespace triptych::vulkan_backend
