#pragma once
#include <memory>

#include "backends/vulkan/frames.hpp"
#include "backends/vulkan/instance.hpp"
#include "backends/vulkan/volume_resources.hpp"
#include "measure/contract/pixel_history.hpp"

namespace triptych::vulkan_backend {

// A volume technique that runs as a compute kernel, with one invocation per pixel.
class ComputeFrames final : public measure::Prepared, public measure::PixelTracer {
 public:
  ComputeFrames(const Gpu& gpu, const Instance& instance, const measure::VolumeWork& work,
                const Constants& constants);

  void poison() override;
  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override;
  [[nodiscard]] std::string kernel_hash() const override;
  [[nodiscard]] technique::RayTrace trace(int x, int y) override;

 private:
  void record_timed(const vk::raii::CommandBuffer& commands) const;
  void dispatch(const vk::raii::CommandBuffer& commands, Pass pass, int columns) const;
  void prepare_counters();
  void record_counters(std::string_view code);
  [[nodiscard]] measure::Frame submit_parts(measure::Purpose purpose);

  const Gpu& gpu_;
  const Instance& instance_;
  Constants constants_;
  int width_;
  int height_;
  int drawn_columns_;
  Buffer output_;
  VolumeResources resources_;
  std::string_view timed_code_;
  std::string_view counting_code_;
  std::string_view tracing_code_;  // empty if this work cannot be traced
  vk::Pipeline pipeline_;
  vk::Pipeline counting_pipeline_;  // null until work is to be counted
  Frames frames_;
};

}  // namespace triptych::vulkan_backend
