#pragma once
// Draws frames on one device, one at a time, and determines how each fails.

#include <chrono>
#include <optional>
#include <string>

#include "measure/run/runner.hpp"
#include "measure/run/single_frames.hpp"
#include "measure/truth/truths.hpp"
#include "record/store.hpp"
#include "reduction/failure.hpp"

namespace triptych::reduction {

// The results of drawing the first frame twice, because a failure that does not repeat cannot be
// reduced.
struct FirstFrames {
  std::optional<Failure> first;  // nullopt: it is right, and was drawn only once
  std::optional<Failure> again;

  [[nodiscard]] bool repeats() const { return first && again && is_same_kind(*again, *first); }
};

// All arguments must outlive this object.
class Trial {
 public:
  // `other` is the device whose counters are right; empty if counters are not compared.
  Trial(const measure::Suite& suite, const std::string& device, const std::string& other,
        const measure::RunOptions& options, measure::Truths& truths, record::Store& store);

  // Throws what measure::SingleFrames::draw throws.
  std::optional<Failure> operator()(const measure::Configuration& configuration);

  // Draws the first frame, and again if it fails. Throws record::NotMeasured if it was skipped.
  [[nodiscard]] FirstFrames first(const measure::Configuration& start);

  [[nodiscard]] const record::Record& last() const noexcept { return last_; }
  [[nodiscard]] record::Device device() const { return frames_.device(); }

 private:
  [[nodiscard]] Evidence evidence(const measure::Configuration& configuration);

  measure::InterruptGuard interrupts_;
  measure::Truths& truths_;
  measure::SingleFrames frames_;
  std::optional<measure::SingleFrames> other_;
  record::Record last_;
};

// The time after which a frame of the search counts as hung. It should be short, because each frame
// that hangs takes this time. But a driver may take longer than that to crash, and the crash would
// then look like a hang. Therefore the limit depends on the time of the first frame, which is drawn
// with the limit of a normal run.
[[nodiscard]] std::chrono::seconds limit_by_first_frame(const measure::Suite& suite,
                                                        const std::string& device,
                                                        const measure::Configuration& start,
                                                        measure::RunOptions options,
                                                        record::Store& store);

}  // namespace triptych::reduction
