#pragma once
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "backends/vulkan/vulkan.hpp"

namespace triptych::vulkan_backend {

// The name of each shader of a pipeline, by its stage: "sphere.frag" for a fragment shader.
using StageNames = std::vector<std::pair<vk::ShaderStageFlagBits, std::string>>;

// The pipelines of an open device. Each is built once for all work that is prepared on the device.
// A VkPipelineCache would leave that decision to the driver, and lavapipe stores nothing in one, so
// that building pipelines would take most of the time of a short frame.
class Pipelines {
 public:
  // Builds a pipeline with these flags.
  using Make = std::function<vk::raii::Pipeline(vk::PipelineCreateFlags)>;

  // The pipeline that was made for this key before; otherwise the result of `make`, which then
  // lives as long as the device. The key must contain all properties of the pipeline, including its
  // layout: a pipeline can be used with every layout that has the same definition.
  [[nodiscard]] vk::Pipeline get(const std::string& key, const StageNames& stages,
                                 const Make& make);

  struct Captured {
    StageNames stages;
    vk::Pipeline pipeline;
    bool operator==(const Captured&) const = default;
  };
  // From now on, pipelines are created so that the driver reports their compiled code, and every
  // requested pipeline is recorded once.
  void start_capture();
  // Ends this, and returns the recorded pipelines in the order of the requests.
  [[nodiscard]] std::vector<Captured> end_capture();

 private:
  std::map<std::string, vk::raii::Pipeline> made_;
  bool captures_ = false;
  std::vector<Captured> captured_;
};

}  // namespace triptych::vulkan_backend
