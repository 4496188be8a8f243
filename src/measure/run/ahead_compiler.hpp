#pragma once
// Compiles the device code of configurations before their instructions are counted under an
// emulator. Under the emulator, PoCL's compiler takes 30 times as long as in an ordinary process. A
// worker that runs without the emulator therefore draws each configuration first. The driver stores
// the compiled code in the cache folder of the worker under the emulator, which then only loads the
// code. Both workers would compile the same code, bit by bit, because the environment makes the
// driver compile for the CPU that the emulator simulates.

#include <chrono>
#include <string>
#include <utility>

#include "measure/worker/worker_slot.hpp"

namespace triptych::measure {

class AheadCompiler {
 public:
  // `setup` is the result of ahead_setup(). `suite` is the name of the suite.
  AheadCompiler(WorkerSetup setup, std::string suite, InterruptGuard& interrupts)
      : limit_(setup.limit), suite_(std::move(suite)), slot_(std::move(setup), interrupts) {}

  // Draws the configuration of a job. If that fails, the worker under the emulator compiles the
  // code itself, and its record states what is wrong. Throws Interrupted.
  void compile(Job job);

  void finish() { slot_.finish(); }

  // Returns the total time that compile() has taken so far, including the time to open the device.
  [[nodiscard]] double spent_ns() const noexcept { return spent_ns_; }

 private:
  std::chrono::milliseconds limit_;
  std::string suite_;
  WorkerSlot slot_;
  double spent_ns_ = 0;
};

}  // namespace triptych::measure
