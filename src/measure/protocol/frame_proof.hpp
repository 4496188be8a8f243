#pragma once
// Proof that every frame whose time, image, statistics or counters are kept was drawn by that
// frame. A driver may report a command buffer as finished that it executed only the first time; the
// image of an earlier frame is still there and looks right.

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/image.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::measure {

// Draws frames of one prepared technique. Each starts from overwritten outputs
// (Prepared::poison()), and what it leaves is compared with the first frame's, bit for bit: the
// scene and the camera stand still. Both happen outside of what the frame times.
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
  // counts, and frames after a jump of the camera, which draw what the frame before did not show.
  // Throws NotDrawn if no pixel has a value, or fewer have one than in the first frame.
  void check_drawn(std::string_view what);

  // The image of the next check() is the one that later ones have to repeat, instead of the
  // first's: what is warmed up may differ from the very first frame. It still has to be drawn.
  void begin_again() { renewed_ = true; }

  // start() and one frame; the check is the caller's.
  [[nodiscard]] Frame draw(Purpose purpose) {
    start();
    return prepared_.frame(purpose);
  }

  [[nodiscard]] Prepared& prepared() { return prepared_; }

  // The image that was checked last.
  [[nodiscard]] core::Image take_image() { return std::move(last_); }

 private:
  void read(std::string_view what);

  Prepared& prepared_;
  bool started_ = false;
  bool renewed_ = false;
  std::optional<core::Image> first_;
  core::Image last_;
  std::size_t first_without_value_ = 0;
  std::size_t without_value_ = 0;
};

// Frames of the wall-clock loop follow each other at once, so only its last is checked. Throws
// NotDrawn where one of them lasted less than a tenth of the fastest frame that was proven: a
// factor of ten is more than clocks that rise under load, or caches, explain. Frames below 2 ms are
// not judged: a tenth of them is within the cost of a launch.
void check_loop(const std::vector<double>& loop_wall_ns, const std::vector<double>& proven_wall_ns);

}  // namespace triptych::measure
