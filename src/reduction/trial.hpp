#pragma once
// Draws frames on one device, one at a time, and determines how each frame fails.

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "measure/run/runner.hpp"
#include "measure/run/single_frames.hpp"
#include "measure/truth/truths.hpp"
#include "record/store.hpp"
#include "reduction/failure.hpp"

namespace triptych::reduction {

// The results of drawing the frame with which a search begins. It is drawn twice if it fails,
// because a failure that does not repeat cannot be reduced.
struct FirstFrames {
  std::optional<Failure> first_failure;  // nullopt: the frame is correct and was drawn only once
  std::optional<Failure> second_failure;

  [[nodiscard]] bool repeats() const {
    return first_failure && second_failure && is_same_kind(*second_failure, *first_failure);
  }
};

// Draws configurations. All arguments of the constructor must outlive this object.
class Trial {
 public:
  // `other` is the device whose counters are correct, or empty if counters are not compared.
  Trial(const measure::Suite& suite, const std::string& device, const std::string& other,
        const measure::RunOptions& options, measure::Truths& truths, record::Store& store);

  // Throws the same exceptions as measure::SingleFrames::draw().
  std::optional<Failure> operator()(const measure::Configuration& configuration);

  // Draws `start`, the configuration with which a search begins, and draws it again if it fails.
  // Throws record::NotMeasured if it was skipped.
  [[nodiscard]] FirstFrames draw_first(const measure::Configuration& start);

  // Draws the configurations of `before` and then `configuration`, all in a new worker process, and
  // returns how the last one fails.
  std::optional<Failure> draw_after(std::span<const measure::Configuration> before,
                                    const measure::Configuration& configuration);

  [[nodiscard]] const record::Record& last() const noexcept { return last_; }
  [[nodiscard]] record::Device device() const { return frames_->device(); }

 private:
  [[nodiscard]] Evidence evidence(const measure::Configuration& configuration);

  measure::InterruptGuard interrupts_;
  measure::Truths& truths_;
  std::function<void()> replace_worker_;
  std::optional<measure::SingleFrames> frames_;
  std::optional<measure::SingleFrames> other_;
  record::Record last_;
};

// Returns the time after which a frame of the search counts as hung. The limit should be short,
// because each hanging frame uses it up completely. However, with too short a limit, a driver that
// takes a long time to crash would seem to hang. Therefore the limit is derived from the time of
// the first frame, which is drawn with the limit of a normal run.
[[nodiscard]] std::chrono::seconds limit_by_first_frame(const measure::Suite& suite,
                                                        const std::string& device,
                                                        const measure::Configuration& start,
                                                        measure::RunOptions options,
                                                        record::Store& store);

}  // namespace triptych::reduction
