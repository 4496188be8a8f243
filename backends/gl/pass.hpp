#pragma once
// How a volume technique runs its program, and where its image is stored. Only this differs between
// raycast and raycast_fragment.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "backends/gl/program.hpp"
#include "backends/gl/timing.hpp"
#include "backends/gl/volume_data.hpp"
#include "core/image.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

class Pass {
 public:
  Pass() = default;
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;
  virtual ~Pass() = default;

  // The stages of the program around the shared raycasting source.
  [[nodiscard]] virtual std::vector<Stage> stages(const Api& gl,
                                                  const Constants& constants) const = 0;
  // The pipeline statistics of the stages that it uses.
  [[nodiscard]] virtual std::span<const Statistic> statistics() const = 0;
  // Overwrites the image with NaN.
  virtual void poison(const Api& gl) = 0;
  // If a dump was requested, writes a separate program that draws the frame (standalone.hpp).
  virtual void dump(const measure::VolumeWork& /*work*/, const std::string& /*source*/) const {}
  // Makes its target the current one; called before the clock starts.
  virtual void bind(const Api& gl) = 0;
  // The timed calls: those that draw the image and, except when counting, the injected extra work.
  virtual void submit(const Api& gl, measure::Purpose purpose) = 0;
  // The image. The device must have finished it.
  [[nodiscard]] virtual core::Image read(const Api& gl) const = 0;
};

}  // namespace triptych::gl_backend
