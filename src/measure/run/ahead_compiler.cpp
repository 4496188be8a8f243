#include "measure/run/ahead_compiler.hpp"

#include <variant>

#include "measure/system/stopwatch.hpp"

namespace triptych::measure {

void AheadCompiler::compile(const Configuration& configuration) {
  const Stopwatch stopwatch;
  const bool open = slot_.open([this] { return Start{.suite = suite_, .statistics = false}; },
                               [](const Hello&) {});
  if (open && carries_out(to_message(Hold{.configuration = configuration, .faults = {}})) &&
      carries_out(to_message(Frames{.count = 1}))) {
    carries_out(to_message(Release{}));
  }
  spent_ns_ += stopwatch.ns();
}

bool AheadCompiler::carries_out(const Message& request) {
  const WorkerLink::Reply reply = slot_.worker().ask(request, limit_);
  const auto* answer = std::get_if<Message>(&reply);
  const auto batch = answer != nullptr ? as_batch(*answer) : std::nullopt;
  if (batch) slot_.vacate_after(batch->outcome, batch->reason);
  if (!batch) slot_.vacate();
  return batch && batch->outcome == record::Outcome::measured;
}

}  // namespace triptych::measure
