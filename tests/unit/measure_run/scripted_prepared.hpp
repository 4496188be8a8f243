#pragma once
// A prepared technique that returns scripted times at once and writes down what it was asked.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measure/contract/backend.hpp"

namespace triptych::measure {

class ScriptedPrepared final : public Prepared {
 public:
  // What the n-th frame says, n from 0, whatever its purpose.
  using Script = std::function<Frame(int n)>;
  explicit ScriptedPrepared(Script script) : script_(std::move(script)) {}

  Frame frame(Purpose purpose) override {
    calls.emplace_back(purpose == Purpose::timing       ? "timing"
                       : purpose == Purpose::statistics ? "statistics"
                                                        : "counters");
    Frame frame = script_(frames_++);
    if (purpose == Purpose::statistics) frame.counts = {{"compute_invocations", 64}};
    if (purpose == Purpose::counters) frame.counts = {{"samples", 512}, {"rays_hit", 64}};
    return frame;
  }
  core::Image image() override {
    calls.emplace_back("image");
    core::Image image(2, 1);
    image.rgba[0] = static_cast<float>(frames_);
    return image;
  }
  std::string kernel_hash() const override { return "kernel"; }

  std::vector<std::string> calls;

 private:
  Script script_;
  int frames_ = 0;
};

inline Frame frame_of(double wall_ns, std::optional<double> device_ns = std::nullopt) {
  return {.wall_ns = wall_ns, .device_ns = device_ns, .counts = {}};
}

// The same times for every frame.
inline ScriptedPrepared steady(double wall_ns, std::optional<double> device_ns = std::nullopt) {
  return ScriptedPrepared([=](int) { return frame_of(wall_ns, device_ns); });
}

}  // namespace triptych::measure
