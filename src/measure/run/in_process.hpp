#pragma once
// Draws a single frame in this process, without any other frame before it, for debuggers and for
// tools that record API calls.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/image.hpp"
#include "measure/contract/backend.hpp"
#include "measure/contract/pixel_history.hpp"
#include "measure/contract/suite.hpp"
#include "measure/plan/plan.hpp"
#include "measure/protocol/injected_fault.hpp"
#include "record/record.hpp"

namespace triptych::measure {

struct TracedPixel {
  PixelPlace place;
  technique::RayTrace trace;  // only for a volume
  core::Image image;          // the image that was drawn while `trace` was recorded
  // The history for a particle scene, which is used instead of `trace` and `image`.
  std::optional<accuracy::SpriteHistory> sprites = {};
};

struct FrameInProcess {
  record::Record record;
  core::Image image;
  record::Device device;
  std::size_t not_drawn = 0;          // number of pixels that the frame did not draw
  std::optional<TracedPixel> traced;  // set if a pixel was specified
};

// Draws the only configuration of the plan: opens the device, prepares the technique, draws one
// frame and reads the image back. Nothing is calibrated, counted or repeated. If RenderDoc is
// loaded into the process, it captures exactly this frame, to a file whose name begins with
// `capture`. If a pixel is specified, further frames are drawn to record its history. Throws the
// exceptions of the device's functions, and InputError for a pixel outside the image.
[[nodiscard]] FrameInProcess draw_in_process(const Backend& backend, std::string_view device_id,
                                             Suite& suite, const Plan& plan,
                                             std::span<const InjectedFault> faults,
                                             const std::string& capture,
                                             std::optional<PixelPlace> pixel = std::nullopt);

}  // namespace triptych::measure
