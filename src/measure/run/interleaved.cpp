#include "measure/run/interleaved.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "measure/protocol/clock.hpp"
#include "measure/protocol/count_to_fill.hpp"
#include "measure/worker/worker_slot.hpp"

namespace triptych::measure {
namespace {

constexpr std::array<Side, 2> both_sides{Side::a, Side::b};
constexpr double infinite = std::numeric_limits<double>::infinity();

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double ln_mean(const std::array<double, 2>& times_ns) {
  constexpr double least_ns = 1;
  return 0.5 *
         (std::log(std::max(times_ns[0], least_ns)) + std::log(std::max(times_ns[1], least_ns)));
}

}  // namespace

std::string_view name_of(Side side) {
  return side == Side::a ? "a" : "b";
}

std::vector<double> differences(std::span<const Block> blocks, SideClock clock) {
  std::vector<double> result;
  result.reserve(blocks.size());
  for (const Block& block : blocks) {
    const auto ln_time = [clock](const SideTimes& times) {
      return ln_mean(clock == SideClock::device ? times.device_ns.value() : times.wall_ns);
    };
    result.push_back(ln_time(block.b) - ln_time(block.a));
  }
  return result;
}

bool device_times_plausible(std::span<const Block> blocks) {
  for (const auto side : {&Block::a, &Block::b}) {
    std::vector<double> wall_ns;
    std::vector<double> device_ns;
    for (const Block& block : blocks) {
      const SideTimes& times = block.*side;
      if (!times.device_ns) return false;
      wall_ns.insert(wall_ns.end(), times.wall_ns.begin(), times.wall_ns.end());
      device_ns.insert(device_ns.end(), times.device_ns->begin(), times.device_ns->end());
    }
    if (!plausible(device_ns, wall_ns)) return false;
  }
  return true;
}

// One side of the comparison (a device, driver or build), with its current worker process.
class Interleaved::Slot {
 public:
  Slot(Side side, const SideOptions& side_options, const InterleavedOptions& options,
       InterruptGuard& interrupts)
      : side_(side),
        options_(options),
        cache_(cache_name(side_options, false)),
        slot_(worker_setup(side_options, false, cache_, options.start_limit), interrupts) {}

  [[nodiscard]] const Hello& hello() const { return hello_; }
  [[nodiscard]] const record::Reason& why_closed() const { return slot_.why_closed(); }

  // Like WorkerSlot::open(). Replacement workers use the clock calibration of the side's first
  // worker.
  bool open() {
    return slot_.open(
        [this] {
          return Start{.suite = options_.suite, .kinds = options_.kinds, .clocks = hello_.clocks};
        },
        [this](const Hello& hello) {
          if (hello_.device.id.empty()) hello_ = hello;
        });
  }

  void close() { slot_.finish(); }

  // Sends a request. Throws SideEnded unless the answer is a message of the expected kind.
  template <typename As>
  auto send_request(const Message& message, As as, const OnLoading& on_loading) {
    if (!open()) throw SideEnded(side_, record::Outcome::failed, why_closed());
    WorkerLink::Reply reply = slot_.worker().send_request(message, options_.limit, on_loading);
    if (const auto* died = std::get_if<WorkerLink::Died>(&reply)) {
      give_up(record::Outcome::crashed, died->reason);
    }
    if (const auto* timed_out = std::get_if<WorkerLink::TimedOut>(&reply)) {
      give_up(record::Outcome::hung, timed_out->reason);
    }
    Message& answer = std::get<Message>(reply);
    if (const auto refused = as_refused(answer)) give_up(record::Outcome::failed, refused->reason);
    try {
      if (auto expected = as(std::move(answer))) return std::move(*expected);
    } catch (const core::InputError& error) {
      give_up(record::Outcome::failed,
              {.cause = record::Cause::bad_answer, .detail = error.what()});
    }
    give_up(record::Outcome::failed, {.cause = record::Cause::bad_answer});
  }

  // Throws SideEnded unless the outcome is `measured`.
  void require_measured(record::Outcome outcome, const record::Reason& reason) {
    if (outcome == record::Outcome::measured) return;
    slot_.vacate_after(outcome, reason);
    throw SideEnded(side_, outcome, reason);
  }

  Batch batch(const Message& message, const OnLoading& on_loading = {}) {
    Batch batch = send_request(
        message, [](const Message& answer) { return as_batch(answer); }, on_loading);
    require_measured(batch.outcome, batch.reason);
    return batch;
  }

  // Draws this many frames and returns their times.
  Batch draw(int frames) {
    Batch drawn = batch(to_message(Frames{.count = frames}));
    if (drawn.wall_ns.size() != static_cast<std::size_t>(frames)) {
      give_up(record::Outcome::failed,
              {.cause = record::Cause::bad_answer,
               .numbers = {{"frames_requested", frames},
                           {"frames_drawn", static_cast<double>(drawn.wall_ns.size())}}});
    }
    return drawn;
  }

  void release() {
    if (slot_.occupied()) static_cast<void>(batch(to_message(Release{})));
  }

 private:
  [[noreturn]] void give_up(record::Outcome outcome, const record::Reason& reason) {
    slot_.vacate();
    throw SideEnded(side_, outcome, reason);
  }

  Side side_;
  const InterleavedOptions& options_;
  CacheFolder cache_;
  WorkerSlot slot_;
  Hello hello_;
};

Interleaved::Interleaved(InterleavedOptions options, const SideOptions& a, const SideOptions& b)
    : options_(std::move(options)), random_(options_.seed) {
  if (const auto reason = reason_not_to_measure()) throw core::InputError(*reason);
  for (const SideOptions* side : {&a, &b}) {
    if (const auto reason = reason_not_to_measure(side->environment))
      throw core::InputError(*reason);
  }
  slots_[0] = std::make_unique<Slot>(Side::a, a, options_, interrupts_);
  slots_[1] = std::make_unique<Slot>(Side::b, b, options_, interrupts_);
  // Opens the workers of the two compared sides one after the other. Each worker calibrates its
  // clocks while it is opened, and the other worker would disturb the calibration.
  for (const auto& each : slots_) {
    if (!each->open()) throw record::NotMeasured(record::Outcome::skipped, each->why_closed());
  }
}

Interleaved::~Interleaved() = default;

const Hello& Interleaved::hello(Side side) const {
  return slot(side).hello();
}

void Interleaved::hold(const Configuration& configuration,
                       const std::array<std::vector<std::string>, 2>& faults, SideClock clock,
                       const OnLoading& on_loading) {
  constexpr int warm_up_frames = 3;
  constexpr int most_frames = 1000;
  constexpr int most_repetitions = 10;
  for (const Side side : both_sides) {
    const Hold request{configuration, faults.at(side == Side::a ? 0 : 1)};
    static_cast<void>(slot(side).batch(to_message(request), on_loading));
  }
  double fastest_ns = infinite;
  for (const Side side : both_sides) {
    const Batch batch = slot(side).draw(warm_up_frames);
    const bool by_device = clock == SideClock::device && !batch.device_ns.empty();
    fastest_ns =
        std::min(fastest_ns, std::ranges::min(by_device ? batch.device_ns : batch.wall_ns));
  }
  frames_per_batch_ = count_to_fill(options_.least_batch_ns, fastest_ns, most_frames);
  repetitions_per_block_ =
      count_to_fill(options_.least_block_ns, 4 * frames_per_batch_ * fastest_ns, most_repetitions);
  for (const Side side : both_sides) static_cast<void>(slot(side).draw(frames_per_batch_));
}

Block Interleaved::block() {
  Block block{.b_first = random_.uniform() < 0.5, .a = {}, .b = {}};
  for (SideTimes* times : {&block.a, &block.b}) {
    times->wall_ns.fill(infinite);
    times->device_ns.emplace().fill(infinite);
  }
  for (int i = 0; i < repetitions_per_block_; ++i) measure_batches(block);
  return block;
}

void Interleaved::measure_batches(Block& block) {
  const Side first = block.b_first ? Side::b : Side::a;
  const Side second = block.b_first ? Side::a : Side::b;
  std::array<std::size_t, 2> batches{};
  for (const Side side : {first, second, second, first}) {
    const Batch batch = slot(side).draw(frames_per_batch_);
    SideTimes& times = side == Side::a ? block.a : block.b;
    const std::size_t number = batches.at(side == Side::a ? 0 : 1)++;
    double& wall_ns = times.wall_ns.at(number);
    wall_ns = std::min(wall_ns, mean_of(batch.wall_ns));
    if (batch.device_ns.empty()) times.device_ns.reset();
    if (!times.device_ns) continue;
    double& device_ns = times.device_ns->at(number);
    device_ns = std::min(device_ns, mean_of(batch.device_ns));
  }
}

void Interleaved::release() {
  for (const Side side : both_sides) slot(side).release();
}

void Interleaved::restart() {
  for (const auto& each : slots_) each->close();
  for (const Side side : both_sides) {
    if (!slot(side).open()) throw SideEnded(side, record::Outcome::failed, slot(side).why_closed());
  }
}

}  // namespace triptych::measure
