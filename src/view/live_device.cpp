#include "view/live_device.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "measure/worker/own_program.hpp"
#include "record/factor_list.hpp"
#include "technique/catalogue.hpp"

namespace triptych::view {
namespace {

constexpr std::chrono::seconds opening_limit{60};

// Returns the protocol for measuring a frame. If the camera is at rest, this is the protocol for
// times that do not affect a verdict. While the camera moves, one warm-up frame and one timed frame
// are enough.
measure::Protocol protocol_of(const FrameRequest& request) {
  measure::Protocol protocol = measure::brief_protocol;
  protocol.measure_every = true;
  if (request.moving) {
    protocol.warm_up_frames = 1;
    protocol.timed_frames = 1;
    protocol.statistics = false;
    protocol.counters = false;
  }
  return protocol;
}

measure::WorkerSetup setup_of(const measure::ViewSide& side, const std::string& program,
                              const measure::CacheFolder& cache) {
  const measure::SideOptions options{.device = side.device,
                                     .command = measure::worker_command(program),
                                     .environment = side.environment};
  return measure::worker_setup(options, false, cache, opening_limit);
}

std::string cache_of(const measure::ViewSide& side) {
  return measure::cache_name(
      {.device = side.device, .command = {}, .environment = side.environment}, false);
}

record::Record ended(record::Outcome outcome, record::Reason reason) {
  record::Record record;
  record.outcome = outcome;
  record.reason = std::move(reason);
  return record;
}

}  // namespace

LiveDevice::LiveDevice(const measure::ViewSide& side, LiveOptions options,
                       measure::InterruptGuard& interrupts, std::function<void()> changed)
    : options_(std::move(options)),
      device_(side.device),
      changed_(std::move(changed)),
      cache_(cache_of(side)),
      slot_(setup_of(side, options_.program, cache_), interrupts),
      thread_([this] { serve(); }) {}

LiveDevice::~LiveDevice() {
  retire();
  thread_.join();
}

void LiveDevice::retire() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
}

void LiveDevice::draw(FrameRequest request) {
  {
    const std::lock_guard lock(mutex_);
    request_ = std::move(request);
  }
  wake_.notify_one();
}

LiveDevice::State LiveDevice::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void LiveDevice::update_state(const std::function<void(State&)>& change) {
  {
    const std::lock_guard lock(mutex_);
    change(state_);
  }
  changed_();
}

std::optional<FrameRequest> LiveDevice::next() {
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [this] { return stop_ || request_; });
  if (stop_) return std::nullopt;
  return std::exchange(request_, std::nullopt);
}

void LiveDevice::serve() {
  try {
    while (const auto request = next()) {
      update_state([](State& state) { state.drawing = true; });
      auto answer = std::make_shared<const DrawnFrame>(draw_frame(*request));
      update_state([&](State& state) { state = {.drawn = std::move(answer), .loading = {}}; });
    }
    static_cast<void>(slot_.finish());
  } catch (const measure::Interrupted&) {
    slot_.vacate();  // the window is being closed
  }
  has_exited_ = true;
  changed_();
}

DrawnFrame LiveDevice::draw_frame(const FrameRequest& request) {
  DrawnFrame answer{.request = request, .record = {}, .image = {}, .displayed = {}};
  std::vector<std::byte> exr;
  try {
    answer.record = measure_frame(request, exr);
    if (!exr.empty()) {
      answer.image = core::decode_exr(exr, "the image of " + device_);
      answer.displayed = core::to_srgb(answer.image);
    }
  } catch (const measure::Interrupted&) {
    throw;
  } catch (const core::Error& error) {
    answer.record = ended(record::Outcome::failed,
                          {.cause = record::Cause::bad_answer, .detail = error.what()});
  }
  answer.record.device = device_;
  answer.record.suite = options_.suite;
  answer.record.configuration = request.key;
  answer.record.technique = request.configuration.at("technique");
  if (answer.record.factors.empty()) answer.record.factors = request.configuration;
  return answer;
}

measure::Job LiveDevice::job(const FrameRequest& request) const {
  return {.name = device_ + "/" + request.key,
          .configuration = request.configuration,
          .protocol = protocol_of(request),
          .faults = measure::faults_for(options_.faults, request.key, device_)};
}

bool LiveDevice::open_worker(const std::string& kind) {
  const bool known = std::ranges::find(clocks_, kind, &record::ClockTrust::work) != clocks_.end();
  if (slot_.occupied() && !known) static_cast<void>(slot_.finish());
  return slot_.open(
      [&] { return measure::Start{.suite = options_.suite, .kinds = {kind}, .clocks = clocks_}; },
      [&](const measure::Hello& hello) { clocks_ = hello.clocks; });
}

record::Record LiveDevice::measure_frame(const FrameRequest& request, std::vector<std::byte>& exr) {
  const auto& technique = technique::technique(request.configuration.at("technique"));
  if (!open_worker(std::string(technique::name_of(technique.work)))) {
    return ended(slot_.unsupported() ? record::Outcome::skipped : record::Outcome::failed,
                 slot_.why_closed());
  }
  auto reply = slot_.run_job(to_message(job(request)), options_.limit, [&](const auto& loading) {
    update_state([&](State& state) { state.loading = loading; });
  });
  if (auto* lost = std::get_if<measure::WorkerSlot::Ended>(&reply)) {
    return ended(lost->outcome, std::move(lost->reason));
  }
  measure::Answer& answer = std::get<measure::Answer>(reply);
  exr = std::move(answer.exr);
  return std::move(answer.record);
}

}  // namespace triptych::view
