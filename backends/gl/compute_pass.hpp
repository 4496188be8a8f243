#pragma once
#include <optional>
#include <string>

#include "backends/gl/pass.hpp"
#include "backends/gl/volume_data.hpp"

namespace triptych::gl_backend {

// Returns the reason why shaders cannot use storage blocks; nullopt if they can.
[[nodiscard]] std::optional<std::string> storage_unsupported(const Api& gl);

// Runs one invocation per pixel. Each invocation writes its pixel into a storage buffer. Used by
// raycast and speed_of_light.
class ComputePass final : public Pass {
 public:
  ComputePass(const Api& gl, int width, int height, int extra_work_stride);

  // Returns the reason why an image of this size cannot be computed; nullopt if it can.
  [[nodiscard]] static std::optional<std::string> unsupported(const Api& gl, int width, int height);

  [[nodiscard]] std::vector<Stage> stages(const Api& gl, const Constants& constants) const override;
  [[nodiscard]] std::span<const Statistic> statistics() const override;
  void poison(const Api& gl) override { poison_buffer(gl, pixels_); }
  void dump(const measure::VolumeWork& work, const std::string& source) const override;
  void bind(const Api& gl) override;
  void submit(const Api& gl, measure::Purpose purpose) override;
  [[nodiscard]] core::Image read(const Api& gl) const override;

 private:
  int width_;
  int height_;
  int drawn_columns_;
  Buffer pixels_;
};

}  // namespace triptych::gl_backend
