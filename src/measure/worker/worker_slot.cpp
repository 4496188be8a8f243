#include "measure/worker/worker_slot.hpp"

#include <utility>

#include "core/error.hpp"
#include "measure/system/stopwatch.hpp"

namespace triptych::measure {

bool WorkerSlot::open(const std::function<Start()>& start,
                      const std::function<void(const Hello&)>& greeted) {
  constexpr int most_attempts = 2;
  for (int attempt = 0; !occupied() && !why_closed_.is_one(); ++attempt) {
    Refused refused = try_to_open(start(), greeted);
    const bool last = refused.unsupported() || attempt + 1 >= most_attempts;
    if (refused.is_one() && last) why_closed_ = std::move(refused);
  }
  return occupied();
}

void WorkerSlot::finish() {
  if (worker_) worker_->finish();
  worker_.reset();
}

Refused WorkerSlot::try_to_open(const Start& start,
                                const std::function<void(const Hello&)>& greeted) {
  std::vector<std::string> command = setup_.command;
  command.push_back(setup_.device);
  const auto closed = [this](Refused refused) {
    refused.reason.stage = record::Stage::opening;
    if (refused.reason.subject.empty()) refused.reason.subject = setup_.device;
    return refused;
  };
  std::unique_ptr<WorkerLink> worker;
  try {
    worker = std::make_unique<WorkerLink>(command, setup_.environment, interrupts_);
  } catch (const core::IoError& error) {
    return closed({{.cause = record::Cause::cannot_start, .detail = error.what()}});
  }
  const Stopwatch opening;
  const auto greeting = worker->greet(start, setup_.limit);
  opening_ns_ += opening.ns();
  if (const auto* refused = std::get_if<Refused>(&greeting)) return closed(*refused);
  greeted(std::get<Hello>(greeting));
  worker_ = std::move(worker);
  return {};
}

}  // namespace triptych::measure
