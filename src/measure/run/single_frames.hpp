#pragma once
// Frames that are drawn one at a time, each chosen when the one before was seen.

#include <string>

#include "measure/run/device_run.hpp"

namespace triptych::measure {

// One device with its worker, which is replaced where it dies. A frame for the picture and one for
// the counters each, untimed; records and pictures go to the store. What is passed must live as
// long.
class SingleFrames {
 public:
  // Throws InputError as run_plans() does.
  SingleFrames(const Suite& suite, std::string device, record::Store& store,
               const RunOptions& options, InterruptGuard& interrupts);

  // Throws Interrupted, and IoError when the store cannot be written.
  [[nodiscard]] record::Record draw(const Configuration& configuration);

  // What it turned out to be when it was opened. Throws InputError where it never was.
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
