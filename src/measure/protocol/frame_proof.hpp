#pragma once
// Proves that each recorded time, image, statistic and counter comes from a frame that was really
// drawn. A faulty driver may execute a command buffer only the first time, but report it as
// finished every time. In this case, the image of the earlier frame is still in memory and looks
// correct.

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/image.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::measure {

// Draws frames of one prepared technique. The outputs are overwritten before each frame
// (Prepared::poison()). Because neither the scene nor the camera moves, the outputs of each frame
// must be bit-identical to those of the first frame. Overwriting and comparing are not included in
// the time of the frame.
class FrameProof {
 public:
  explicit FrameProof(Prepared& prepared) : prepared_(prepared) {}

  // Overwrites the outputs. Everything that is drawn until the next check() counts as one frame.
  // The first call also checks whether the outputs were overwritten, and throws NotDrawn if they
  // were not.
  void start();
  // Checks the frame and returns its image. Throws NotDrawn if no pixel was drawn since start(), if
  // fewer pixels were drawn than in the first check, or if the image differs from that of the first
  // check. In the message, `what` describes the frame, such as "timed frame 3 of 8".
  const core::Image& check(std::string_view what);
  // Checks a frame whose image may differ from the first image. This is the case for a frame of the
  // counting build, and for a frame after a camera jump, which also draws cells (groups of
  // particles that are culled together) that were not visible in the previous frame. Throws
  // NotDrawn if no pixel was drawn, or fewer pixels than in the first frame.
  void check_drawn(std::string_view what);

  // Makes the image of the next check() the image with which later frames are compared, because a
  // frame after the warm-up may differ from the very first frame. That check() still requires that
  // its frame was drawn.
  void renew_reference() { renew_reference_ = true; }

  // Calls start() and draws one frame; the caller checks it.
  [[nodiscard]] Frame draw(Purpose purpose) {
    start();
    return prepared_.frame(purpose);
  }

  [[nodiscard]] Prepared& prepared() { return prepared_; }

  // Returns the number of pixels that the most recently checked frame did not draw.
  [[nodiscard]] std::size_t pixels_not_drawn() const { return without_value_; }
  // Returns the most recently checked image.
  [[nodiscard]] core::Image take_image() { return std::move(last_); }

 private:
  void read(std::string_view what);
  [[nodiscard]] std::size_t pixels_without_value(const core::Image& image) const;

  Prepared& prepared_;
  bool started_ = false;
  bool renew_reference_ = false;
  // The fill value as it was read back after poison(). The device may have changed the bits of the
  // NaN.
  std::array<float, 4> fill_value_{};
  std::optional<core::Image> first_;
  core::Image last_;
  std::size_t first_without_value_ = 0;
  std::size_t without_value_ = 0;
};

// Checks the frame times of the wall-clock loop. Its frames follow each other without a pause, so
// only the last image can be checked. Throws NotDrawn if a frame took less than a tenth of the time
// of the fastest frame whose image was checked (`proven_wall_ns`), because neither rising clock
// rates nor caches explain a factor of ten. Frames that take less than 2 ms are not judged, because
// a tenth of that may be just the time of a launch.
//
// On a busy machine, all checked frames may have been slow. Therefore, before it throws, the
// function draws more frames with `draw_checked`, which returns the wall time of a frame after
// checking its image. It throws only if none of a hundred checked frames is fast enough to explain
// the fastest frame of the loop.
void check_loop(const std::vector<double>& loop_wall_ns, std::vector<double> proven_wall_ns,
                const std::function<double()>& draw_checked);

}  // namespace triptych::measure
