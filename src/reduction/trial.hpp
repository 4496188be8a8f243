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

// All arguments must outlive this object.
class Trial {
 public:
  // `other` is the device whose counters are right; empty if counters are not compared.
  Trial(const measure::Suite& suite, const std::string& device, const std::string& other,
        const measure::RunOptions& options, measure::Truths& truths, record::Store& store);

  // Throws what measure::SingleFrames::draw throws.
  std::optional<Failure> operator()(const measure::Configuration& configuration);

  // Draws the first frame twice. A failure that occurs only once cannot be made smaller, and
  // NotSupported is thrown. Throws record::NotMeasured if the frame was skipped.
  [[nodiscard]] std::optional<Failure> first(const measure::Configuration& start);

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

// The time after which a frame of the search is regarded as hung. It is short, because a hang costs
// this time for every frame. However, a driver may take longer to end, and a crash would then be
// called a hang. Therefore the first frame is drawn with as much time as in a run, and its time
// decides.
[[nodiscard]] std::chrono::seconds limit_by_first_frame(const measure::Suite& suite,
                                                        const std::string& device,
                                                        const measure::Configuration& start,
                                                        measure::RunOptions options,
                                                        record::Store& store);

}  // namespace triptych::reduction
