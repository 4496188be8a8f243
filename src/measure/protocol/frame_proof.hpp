#pragma once
// Proves that each recorded time, image, statistic and counter comes from a frame that was really
// drawn. A driver may execute a command buffer only the first time and report it as finished every
// time. The image of the earlier frame is then still in memory and looks right.

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
// because neither the scene nor the camera moves. Both happen outside of the timed part of the
// frame.
class FrameProof {
 public:
  explicit FrameProof(Prepared& prepared) : prepared_(prepared) {}

  // Overwrites the outputs. Everything that is drawn until the next check() counts as one frame.
  // The first call also checks whether the outputs were overwritten, and throws NotDrawn if they
  // were not.
  void start();
  // Throws NotDrawn if no pixel or fewer pixels than in the first check were drawn since start(),
  // or if the image differs from that of the first check. `what` names the frame in the message,
  // "timed frame 3 of 8". Returns the image.
  const core::Image& check(std::string_view what);
  // For frames whose image need not equal the first one bit for bit: frames of the build that
  // counts, and frames after a jump of the camera, which also draw cells that the previous frame
  // did not show. Throws NotDrawn if no pixel has a value, or fewer have one than in the first
  // frame.
  void check_drawn(std::string_view what);

  // Later frames have to repeat the image of the next check() instead of the first one, because a
  // frame after the warm-up may differ from the very first frame. The next frame still has to be
  // drawn.
  void begin_again() { renewed_ = true; }

  // Calls start() and draws one frame; the caller checks it.
  [[nodiscard]] Frame draw(Purpose purpose) {
    start();
    return prepared_.frame(purpose);
  }

  [[nodiscard]] Prepared& prepared() { return prepared_; }

  // The image that was checked last.
  [[nodiscard]] core::Image take_image() { return std::move(last_); }

 private:
  void read(std::string_view what);
  [[nodiscard]] std::size_t pixels_without_value(const core::Image& image) const;

  Prepared& prepared_;
  bool started_ = false;
  bool renewed_ = false;
  // A pixel that was read back after poison(), because the device may have changed the bits of the
  // NaN.
  std::array<float, 4> filling_{};
  std::optional<core::Image> first_;
  core::Image last_;
  std::size_t first_without_value_ = 0;
  std::size_t without_value_ = 0;
};

// Frames of the wall-clock loop follow each other without a pause, so only the last one is checked.
// Throws NotDrawn if one of them took less than a tenth of the fastest proven frame, because
// neither rising clock rates nor caches explain a factor of ten. Frames below 2 ms are not judged,
// because a tenth of them is within the cost of a launch.
void check_loop(const std::vector<double>& loop_wall_ns, const std::vector<double>& proven_wall_ns);

}  // namespace triptych::measure
