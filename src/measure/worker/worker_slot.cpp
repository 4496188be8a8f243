#include "measure/worker/worker_slot.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"
#include "measure/system/stopwatch.hpp"

namespace triptych::measure {

namespace {

bool died(const record::Reason& reason) {
  return reason.cause == record::Cause::signal || reason.cause == record::Cause::exit_code ||
         reason.cause == record::Cause::timeout;
}

record::DeviceFault statistics_crash(const record::Reason& reason) {
  const auto signal = reason.number("signal");
  return {.kind = record::DeviceFaultKind::statistics_crash,
          .detail = signal ? fmt::format("signal {:.0f}", *signal)
                           : std::string(record::name_of(reason.cause)),
          .last_output = reason.last_output};
}

}  // namespace

bool WorkerSlot::open(const std::function<Start()>& start,
                      const std::function<void(const Hello&)>& on_hello) {
  constexpr int most_attempts = 2;
  for (int attempt = 0; !occupied() && !why_closed_.is_refusal(); ++attempt) {
    Start request = start();
    request.statistics = request.statistics && !statistics_fault_;
    const bool reads_statistics = !request.kinds.empty() && request.statistics;
    Refused refused = try_to_open(request, [&](Hello hello) {
      if (statistics_fault_) hello.device.faults.push_back(*statistics_fault_);
      on_hello(hello);
    });
    if (!refused.is_refusal()) continue;
    if (!refused.unsupported() && attempt + 1 < most_attempts) continue;
    // If the driver crashed or hung in the second attempt, one more attempt is made without
    // pipeline statistics. If it crashes even then, the statistics are not the cause.
    if (reads_statistics && died(refused.reason)) {
      statistics_fault_ = statistics_crash(refused.reason);
    } else {
      statistics_fault_.reset();
      why_closed_ = std::move(refused);
    }
  }
  return occupied();
}

std::variant<Answer, WorkerSlot::Ended> WorkerSlot::run_job(const Message& job,
                                                            std::chrono::milliseconds limit,
                                                            const OnLoading& on_loading) {
  WorkerLink::Reply reply = worker().send_request(job, limit, on_loading);
  Ended ended{record::Outcome::failed, {.cause = record::Cause::bad_answer}};
  if (auto* died = std::get_if<WorkerLink::Died>(&reply)) {
    ended = {record::Outcome::crashed, std::move(died->reason)};
  } else if (auto* timed_out = std::get_if<WorkerLink::TimedOut>(&reply)) {
    ended = {record::Outcome::hung, std::move(timed_out->reason)};
  } else {
    try {
      if (auto answer = as_answer(std::move(std::get<Message>(reply)))) {
        vacate_after(answer->record.outcome, answer->record.reason);
        return std::move(*answer);
      }
    } catch (const core::InputError& error) {
      ended.reason.detail = error.what();
    }
  }
  vacate();
  return ended;
}

void WorkerSlot::vacate_after(record::Outcome outcome, const record::Reason& reason) noexcept {
  if (outcome == record::Outcome::lost || reason.cause == record::Cause::not_drawn) vacate();
}

std::optional<record::DeviceFault> WorkerSlot::finish() {
  std::optional<record::DeviceFault> fault;
  if (worker_) fault = worker_->finish();
  worker_.reset();
  return fault;
}

Refused WorkerSlot::try_to_open(const Start& start,
                                const std::function<void(const Hello&)>& on_hello) {
  std::vector<std::string> command = setup_.command;
  command.push_back(setup_.device);
  const auto closed = [this](Refused refused) {
    refused.reason.stage = record::Stage::opening;
    // The member `detail` already states the call that failed, so the member `subject` names the
    // device.
    refused.reason.subject = setup_.device;
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
  on_hello(std::get<Hello>(greeting));
  worker_ = std::move(worker);
  return {};
}

}  // namespace triptych::measure
