#pragma once
// The common parts of both suites' techniques: frames that consist of drawing calls.

#include <memory>
#include <span>
#include <string>

#include "backends/gl/context.hpp"
#include "backends/gl/timing.hpp"
#include "core/image.hpp"
#include "measure/contract/backend.hpp"
#include "measure/contract/pixel_history.hpp"

namespace triptych::gl_backend {

// A technique with its scene on the device: the data are uploaded and the programs are linked. Its
// context must be current when it is created, used and destroyed.
class Drawing {
 public:
  Drawing() = default;
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;
  virtual ~Drawing() = default;

  // The statistics of the stages that it uses.
  [[nodiscard]] virtual std::span<const Statistic> statistics() const = 0;
  // Overwrites all results of a frame, as measure::Prepared::poison() describes.
  virtual void poison(const Api& gl) = 0;
  // Everything that a frame needs before its clock starts: GL state and, for a counting frame, the
  // counting build.
  virtual void bind(const Api& gl, measure::Purpose purpose) = 0;
  // The calls that are timed.
  virtual void submit(const Api& gl, measure::Purpose purpose) = 0;
  // Called after a frame that counted. The device has finished the frame.
  [[nodiscard]] virtual record::Counts counters(const Api& gl) const = 0;
  // The image. The device has finished it.
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

// The hash of a driver version and of the sources that the driver compiles.
[[nodiscard]] std::string hash_of(const Api& gl, std::span<const std::string> sources);

}  // namespace triptych::gl_backend
