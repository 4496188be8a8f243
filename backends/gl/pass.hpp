#pragma once
// How a volume technique's program is run and where its picture lies: the part in which raycast and
// raycast_fragment differ.

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
  // Statistics of the stages it uses.
  [[nodiscard]] virtual std::span<const Statistic> statistics() const = 0;
  // Overwrites the image with NaN.
  virtual void poison(const Api& gl) = 0;
  // Where a dump is asked for, a program of its own that draws the frame (standalone.hpp).
  virtual void dump(const measure::VolumeWork& /*work*/, const std::string& /*source*/) const {}
  // Makes its target the current one; before the clock starts.
  virtual void bind(const Api& gl) = 0;
  // The calls that are timed: the picture and, but for counters, the injected extra work beside it.
  virtual void submit(const Api& gl, measure::Purpose purpose) = 0;
  // The picture; the device has finished it.
  [[nodiscard]] virtual core::Image read(const Api& gl) const = 0;
};

}  // namespace triptych::gl_backend
