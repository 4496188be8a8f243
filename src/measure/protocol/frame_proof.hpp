#pragma once
// Proves that each recorded time, image, statistic and counter comes from a frame that was really
// drawn. A faulty driver may execute a command buffer only the first time but report it as finished
// every time. The image of the earlier frame is then still in memory and looks correct.

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/image.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::measure {

// Draws frames of one prepared technique. Each frame starts from overwritten outputs
// (Prepared::poison()), and its outputs are compared with those of the first frame, bit for bit,
// because neither the scene nor the camera moves. Overwriting and comparing are not included in the
// time of the frame.
class FrameProof {
 public:
  explicit FrameProof(Prepared& prepared) : prepared_(prepared) {}

  // Overwrites the outputs. Everything that is drawn until the next check() counts as one frame.
  // The first call also checks whether the outputs were overwritten, and throws NotDrawn if they
  // were not.
  void start();
  // Throws NotDrawn if no pixel or fewer pixels than in the first check were drawn since start(),
  // or if the image differs from that of the first check. `what` names the frame in the message,
  // such as "timed frame 3 of 8". Returns the image.
  const core::Image& check(std::string_view what);
  // Checks a frame whose image need not be bit-identical to the first image: a frame of the
  // counting build, or a frame after a camera jump, which also draws cells that the previous frame
  // did not show. Throws NotDrawn if no pixel was drawn, or fewer pixels than in the first frame.
  void check_drawn(std::string_view what);

  // Makes the image of the next check() the one that later frames have to repeat, because a frame
  // after the warm-up may differ from the very first frame. check() still requires that the next
  // frame was drawn.
  void begin_again() { renewed_ = true; }

  // Calls start() and draws one frame; the caller checks it.
  [[nodiscard]] Frame draw(Purpose purpose) {
    start();
    return prepared_.frame(purpose);
  }

  [[nodiscard]] Prepared& prepared() { return prepared_; }

  // Returns the image that was checked last.
  [[nodiscard]] core::Image take_image() { return std::move(last_); }

 private:
  void read(std::string_view what);
  [[nodiscard]] std::size_t pixels_without_value(const core::Image& image) const;

  Prepared& prepared_;
  bool started_ = false;
  bool renewed_ = false;
  // The fill value as it was read back after poison(), because the device may have changed the bits
  // of the NaN.
  std::array<float, 4> filling_{};
  std::optional<core::Image> first_;
  core::Image last_;
  std::size_t first_without_value_ = 0;
  std::size_t without_value_ = 0;
};

// Checks the times of the wall-clock loop, whose frames follow each other without a pause, so that
// only the last image can be checked. Throws NotDrawn if a frame took less than a tenth of the time
// of the fastest proven frame, because neither rising clock rates nor caches explain a factor of
// ten. Frames that take less than 2 ms are not judged, because a tenth of that may be just the time
// of a launch.
void check_loop(const std::vector<double>& loop_wall_ns, const std::vector<double>& proven_wall_ns);

}  // namespace triptych::measure
