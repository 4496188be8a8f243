#pragma once
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "backends/vulkan/vulkan.hpp"

namespace triptych::vulkan_backend {

// Name of each shader of a pipeline by its stage: "sphere.frag" of a fragment shader.
using StageNames = std::vector<std::pair<vk::ShaderStageFlagBits, std::string>>;

// The pipelines of an open device, each built once for all that is prepared on it. A
// VkPipelineCache would leave that to the driver, and Mesa's lavapipe keeps nothing in one: there
// building is most of what a short frame costs.
class Pipelines {
 public:
  // Builds a pipeline with these flags.
  using Make = std::function<vk::raii::Pipeline(vk::PipelineCreateFlags)>;

  // The one made for this key before, else `make`'s; it lives as long as the device. The key has to
  // say all that a pipeline is made of, its layout included: a pipeline goes with every layout that
  // is defined in the same way.
  [[nodiscard]] vk::Pipeline get(const std::string& key, const StageNames& stages,
                                 const Make& make);

  struct Captured {
    StageNames stages;
    vk::Pipeline pipeline;
    bool operator==(const Captured&) const = default;
  };
  // From here on pipelines are made so that the driver reports what it compiled, and those that are
  // asked for are noted, each once.
  void start_capture();
  // Ends it: what was asked for, in that order.
  [[nodiscard]] std::vector<Captured> end_capture();

 private:
  std::map<std::string, vk::raii::Pipeline> made_;
  bool captures_ = false;
  std::vector<Captured> captured_;
};

}  // namespace triptych::vulkan_backend
