#pragma once
// What both suites' techniques have in common: frames made of a drawing.

#include <memory>
#include <span>
#include <string>

#include "backends/gl/context.hpp"
#include "backends/gl/timing.hpp"
#include "core/image.hpp"
#include "measure/contract/backend.hpp"
#include "measure/contract/pixel_history.hpp"

namespace triptych::gl_backend {

// A technique with its scene on the device: data uploaded, programs linked. Made, called and
// destroyed with its context current.
class Drawing {
 public:
  Drawing() = default;
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;
  virtual ~Drawing() = default;

  // Statistics of the stages it uses.
  [[nodiscard]] virtual std::span<const Statistic> statistics() const = 0;
  // Overwrites everything that a frame leaves behind, as measure::Prepared::poison() has it.
  virtual void poison(const Api& gl) = 0;
  // What a frame needs before its clock starts: state, and the counting build where it counts.
  virtual void bind(const Api& gl, measure::Purpose purpose) = 0;
  // The calls that are timed.
  virtual void submit(const Api& gl, measure::Purpose purpose) = 0;
  // Behind a frame that counted, finished by the device.
  [[nodiscard]] virtual record::Counts counters(const Api& gl) const = 0;
  // The picture; the device has finished it.
  [[nodiscard]] virtual core::Image read(const Api& gl) const = 0;
  [[nodiscard]] virtual std::string kernel_hash() const = 0;

  // Draws a frame for measure::TracesPixel.
  [[nodiscard]] virtual technique::RayTrace trace(const Api& /*gl*/, int /*x*/, int /*y*/) {
    throw core::NotSupported(measure::not_traced);
  }
};

// The context must be current here and outlive the result.
[[nodiscard]] std::unique_ptr<measure::Prepared> make_prepared(Context& context, Stamps stamps,
                                                               std::unique_ptr<Drawing> drawing);

// Hash of a driver's version and the sources that it is given.
[[nodiscard]] std::string hash_of(const Api& gl, std::span<const std::string> sources);

}  // namespace triptych::gl_backend
