#pragma once
// Draws frames one at a time. Each can be chosen after the previous one was seen.

#include <string>

#include "measure/run/device_run.hpp"

namespace triptych::measure {

// One device with its worker, which is replaced if it dies. For each configuration it draws one
// frame for the image and one for the counters, without times. Records and images are written to
// the store. All arguments must outlive this object.
class SingleFrames {
 public:
  // Throws InputError like run_plans().
  SingleFrames(const Suite& suite, std::string device, record::Store& store,
               const RunOptions& options, InterruptGuard& interrupts);

  // Throws Interrupted, and IoError if the store cannot be written.
  [[nodiscard]] record::Record draw(const Configuration& configuration);

  // The device as it was when it was opened. Throws InputError if it was never opened.
  [[nodiscard]] record::Device device() const;

 private:
  const Suite& suite_;
  record::Store& store_;
  InterruptGuard& interrupts_;
  RunOptions options_;
  Plan plan_;
  RunContext context_;
  DeviceRun device_;
};

}  // namespace triptych::measure
