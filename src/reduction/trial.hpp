#pragma once
// Frames of one device, drawn one at a time, and how each fails.

#include <chrono>
#include <optional>
#include <string>

#include "measure/run/runner.hpp"
#include "measure/run/single_frames.hpp"
#include "measure/truth/truths.hpp"
#include "record/store.hpp"
#include "reduction/failure.hpp"

namespace triptych::reduction {

// What is passed must live as long.
class Trial {
 public:
  // `other`: the device whose counters are right; empty: nobody's are.
  Trial(const measure::Suite& suite, const std::string& device, const std::string& other,
        const measure::RunOptions& options, measure::Truths& truths, record::Store& store);

  // Throws as measure::SingleFrames::draw does.
  std::optional<Failure> operator()(const measure::Configuration& configuration);

  // Of the first frame, drawn twice: what fails once of two times cannot be made smaller, and is
  // NotSupported. Throws record::NotMeasured where it was skipped.
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

// After which a frame of the search counts as hung. A hang costs its limit with every frame, so it
// is short. But a driver may take longer to end, and what crashed would be called a hang: one frame
// is drawn with as much time as in a run, and tells.
[[nodiscard]] std::chrono::seconds limit_by_first_frame(const measure::Suite& suite,
                                                        const std::string& device,
                                                        const measure::Configuration& start,
                                                        measure::RunOptions options,
                                                        record::Store& store);

}  // namespace triptych::reduction
