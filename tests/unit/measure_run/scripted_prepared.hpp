#pragma once
// A prepared technique that returns scripted times without waiting, and logs all calls.

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measure/contract/backend.hpp"

namespace triptych::measure {

inline constexpr double ms = 1e6;  // one millisecond in nanoseconds

class ScriptedPrepared final : public Prepared {
 public:
  // A function that returns the result of frame n (zero-based), regardless of the frame's purpose.
  using Script = std::function<Frame(int n)>;
  explicit ScriptedPrepared(Script script) : script_(std::move(script)) {}

  void poison() override { image_ = filled(std::numeric_limits<float>::quiet_NaN()); }
  Frame frame(Purpose purpose) override {
    calls.emplace_back(purpose == Purpose::timing       ? "timing"
                       : purpose == Purpose::statistics ? "statistics"
                                                        : "counters");
    Frame frame = script_(frames_++);
    if (draws(frames_)) image_ = filled(value_of_frame(frames_));
    if (purpose == Purpose::statistics) frame.counts = {{"compute_invocations", 64}};
    if (purpose == Purpose::counters) frame.counts = {{"samples", 512}, {"rays_hit", 64}};
    return frame;
  }
  core::Image image() override {
    calls.emplace_back("image");
    return image_;
  }
  std::string kernel_hash() const override { return "kernel"; }

  // A log of all calls except calls to poison(), which frame_proof_test.cpp tests.
  std::vector<std::string> calls;
  // Whether frame n (1-based) writes an image, and the value of that image's pixels.
  std::function<bool(int n)> draws = [](int) { return true; };
  std::function<float(int n)> value_of_frame = [](int) { return 1.0F; };

 private:
  static core::Image filled(float value) {
    core::Image image(2, 1);
    std::ranges::fill(image.rgba, value);
    return image;
  }

  Script script_;
  core::Image image_ = filled(0);
  int frames_ = 0;
};

inline Frame frame_of(double wall_ns, std::optional<double> device_ns = std::nullopt) {
  return {.wall_ns = wall_ns, .device_ns = device_ns, .counts = {}};
}

// Returns a prepared technique with the same times for every frame.
inline ScriptedPrepared steady(double wall_ns, std::optional<double> device_ns = std::nullopt) {
  return ScriptedPrepared([=](int) { return frame_of(wall_ns, device_ns); });
}

}  // namespace triptych::measure
