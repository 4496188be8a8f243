#pragma once
// Draws frames one at a time, so that each configuration can be chosen according to the results of
// the previous frame.

#include <string>

#include "measure/run/device_run.hpp"

namespace triptych::measure {

// A device with its worker, which is replaced if it dies. For each configuration, the worker draws
// the frames of an untimed measurement (Protocol::timed is false), without the frame for pipeline
// statistics. Records and images are written to the store. All arguments must outlive this object.
class SingleFrames {
 public:
  // Throws InputError for an unknown fault, and for environment variables of this process that must
  // not be set while measuring.
  SingleFrames(const Suite& suite, std::string device, record::Store& store,
               const RunOptions& options, InterruptGuard& interrupts);

  // Draws the frames of a configuration and returns its record. Throws Interrupted if a signal asks
  // the program to stop, and IoError if the store cannot be written.
  [[nodiscard]] record::Record draw(const Configuration& configuration);

  // Returns the description of the device, as it was when the device was opened. Throws InputError
  // if the device was never opened.
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
