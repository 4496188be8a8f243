#pragma once
// The parts in which raycast and raycast_fragment differ: how a volume technique runs its program,
// and where it stores its image.

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

  // Returns the stages of the program that contain the shared raycasting source code.
  [[nodiscard]] virtual std::vector<Stage> stages(const Api& gl,
                                                  const Constants& constants) const = 0;
  // Returns the pipeline statistics of the stages that the pass uses.
  [[nodiscard]] virtual std::span<const Statistic> statistics() const = 0;
  // Overwrites the image with NaN.
  virtual void poison(const Api& gl) = 0;
  // If a dump was requested, writes a standalone program that draws the frame (standalone.hpp).
  virtual void dump(const measure::VolumeWork& /*work*/, const std::string& /*source*/) const {}
  // Binds the render target of this pass. Called before the clock starts.
  virtual void bind(const Api& gl) = 0;
  // Makes the timed calls, which draw the image and, except when counting, do the injected extra
  // work.
  virtual void submit(const Api& gl, measure::Purpose purpose) = 0;
  // Reads the image. The device must have finished drawing it.
  [[nodiscard]] virtual core::Image read(const Api& gl) const = 0;
};

}  // namespace triptych::gl_backend
