#pragma once
// Prepares and runs the frames of all techniques, both for volumes and for particles. A frame
// consists of the GL calls of a Drawing.

#include <memory>
#include <span>
#include <string>

#include "backends/gl/context.hpp"
#include "backends/gl/timing.hpp"
#include "core/image.hpp"
#include "measure/contract/backend.hpp"
#include "measure/contract/pixel_history.hpp"

namespace triptych::gl_backend {

// A technique with its scene on the device, after its data were uploaded and its programs linked.
// Its context must be current when the object is created, used and destroyed.
class Drawing {
 public:
  Drawing() = default;
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;
  virtual ~Drawing() = default;

  // Returns the pipeline statistics of the stages that the technique uses.
  [[nodiscard]] virtual std::span<const Statistic> statistics() const = 0;
  // Overwrites all results of a frame, as measure::Prepared::poison() describes.
  virtual void poison(const Api& gl) = 0;
  // Sets up everything that a frame needs before its clock starts: the GL state and, for a counting
  // frame, the program that counts.
  virtual void bind(const Api& gl, measure::Purpose purpose) = 0;
  // Makes the calls that are timed.
  virtual void submit(const Api& gl, measure::Purpose purpose) = 0;
  // Returns the counters. Called after a counting frame that the device has finished.
  [[nodiscard]] virtual record::Counts counters(const Api& gl) const = 0;
  // Reads the image. Called after the device has finished drawing it.
  [[nodiscard]] virtual core::Image read(const Api& gl) const = 0;
  [[nodiscard]] virtual std::string kernel_hash() const = 0;

  // Draws a frame that records the history of pixel (x, y), as measure::PixelTracer describes.
  [[nodiscard]] virtual technique::RayTrace trace(const Api& /*gl*/, int /*x*/, int /*y*/) {
    throw core::NotSupported(measure::pixel_history_of_device_unsupported);
  }
};

// `context` must be current during this call and must outlive the result.
[[nodiscard]] std::unique_ptr<measure::Prepared> make_prepared(Context& context, Stamps stamps,
                                                               std::unique_ptr<Drawing> drawing);

// Returns the hash of the driver version and of the source code that the driver compiles.
[[nodiscard]] std::string hash_of(const Api& gl, std::span<const std::string> sources);

}  // namespace triptych::gl_backend
