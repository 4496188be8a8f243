#include "measure/run/ahead_compiler.hpp"

#include "measure/system/stopwatch.hpp"

namespace triptych::measure {

void AheadCompiler::compile(Job job) {
  const Stopwatch stopwatch;
  job.protocol.ahead = true;
  const bool open = slot_.open([this] { return Start{.suite = suite_, .statistics = false}; },
                               [](const Hello&) {});
  if (open) static_cast<void>(slot_.run_job(to_message(job), limit_, {}));
  spent_ns_ += stopwatch.ns();
}

}  // namespace triptych::measure
