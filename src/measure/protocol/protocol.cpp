#include "measure/protocol/protocol.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "core/hash.hpp"
#include "core/json.hpp"
#include "measure/protocol/benchmark_loop.hpp"
#include "measure/protocol/clock.hpp"
#include "measure/protocol/count_to_fill.hpp"
#include "measure/system/stopwatch.hpp"
#include "record/benchmark_entries.hpp"

namespace triptych::measure {
namespace {

struct WarmUp {
  int frames = 0;
  double fastest_ns = std::numeric_limits<double>::infinity();
};

// The first frames compile, fault pages in and wake threads. Frames too short for four of them to
// have warmed anything are repeated until a tenth of the loop's time has gone by. The fastest
// predicts, so that the loop lasts no less than asked.
WarmUp warm_up(Prepared& prepared, const Protocol& protocol) {
  WarmUp result;
  const double enough_ns = protocol.least_loop_ns / 10;
  double spent_ns = 0;
  while (result.frames < protocol.warm_up_frames ||
         (spent_ns < enough_ns && result.frames < protocol.most_loop_frames)) {
    const Stopwatch whole;
    const Frame frame = prepared.frame(Purpose::timing);
    spent_ns += std::max(frame.wall_ns, whole.ns());
    result.fastest_ns = std::min(result.fastest_ns, frame.wall_ns);
    ++result.frames;
  }
  return result;
}

bool is_trusted(technique::Work kind, const std::vector<record::ClockTrust>& clocks) {
  return std::ranges::any_of(clocks, [kind](const record::ClockTrust& clock) {
    return clock.trusted && clock.work == technique::name_of(kind);
  });
}

// The timed frames. A device that told no time for one of them told none: a list with holes would
// pair the wrong values. The benchmark's real time is the wall time, device time a key beside it:
// whether that is to be believed is known only when all frames are there.
core::Json time_into(record::Record& record, Prepared& prepared, int frames,
                     const std::string& name, double& work_ns) {
  std::vector<std::optional<double>> device_ns;
  record.wall_ns.reserve(static_cast<std::size_t>(frames));
  device_ns.reserve(static_cast<std::size_t>(frames));
  BenchmarkResult result = time_frames(name, frames, [&] {
    const Stopwatch stopwatch;
    const Frame frame = prepared.frame(Purpose::timing);
    work_ns += stopwatch.ns();
    const bool told = frame.device_ns && std::isfinite(*frame.device_ns);
    record.wall_ns.push_back(frame.wall_ns);
    device_ns.push_back(told ? frame.device_ns : std::nullopt);
    IterationTime time{.ns = frame.wall_ns, .facts = {}};
    if (told) time.facts["device_ns"] = *frame.device_ns;
    return time;
  });
  if (std::ranges::all_of(device_ns, [](const auto& ns) { return ns.has_value(); })) {
    for (const auto& ns : device_ns) record.device_ns.push_back(*ns);
  }
  return std::move(result.entries);
}

// Counts are the same for every frame, so they belong to every entry that speaks of a frame; a
// spread (stddev, cv) of them would say nothing.
void add_counts(core::Json& entries, const record::Counts& counts) {
  for (core::Json& entry : entries) {
    const std::string aggregate = entry.value("aggregate_name", "");
    if (aggregate == "stddev" || aggregate == "cv") continue;
    for (const auto& [name, count] : counts) entry[name] = count;
  }
}

}  // namespace

std::string image_hash(const core::Image& image) {
  std::vector<std::byte> bytes;
  const auto append = [&bytes](const auto& values) {
    const auto part = std::as_bytes(std::span(values));
    bytes.insert(bytes.end(), part.begin(), part.end());
  };
  append(std::array<int, 2>{image.width, image.height});
  append(image.rgba);
  append(image.depth);
  append(image.ids);
  return core::content_hash(bytes);
}

namespace {

Measurement untimed(Prepared& prepared, const Protocol& protocol) {
  const Stopwatch whole;
  Measurement result;
  record::Record& record = result.record;
  const Stopwatch drawing;
  static_cast<void>(prepared.frame(Purpose::timing));
  double work_ns = drawing.ns();
  result.image = prepared.image();
  if (protocol.statistics) {
    const Stopwatch querying;
    record.statistics = prepared.frame(Purpose::statistics).counts;
    work_ns += querying.ns();
  }
  if (protocol.counters) {
    const Stopwatch counting;
    record.counters = prepared.frame(Purpose::counters).counts;
    work_ns += counting.ns();
  }
  record.image = image_hash(result.image);
  record.kernel_hash = prepared.kernel_hash();
  record.outcome = record::Outcome::measured;
  record.overhead_ns = whole.ns() - work_ns;
  return result;
}

}  // namespace

Measurement count_instructions(Prepared& prepared, const Protocol& protocol,
                               const InstructionCounter& counter) {
  constexpr int frames_before = 2;
  for (int i = 0; i < frames_before; ++i) static_cast<void>(prepared.frame(Purpose::timing));
  counter.wait_until_quiet();
  Measurement result;
  record::Record& record = result.record;
  static_cast<void>(counter.counting(record.cost, [&] { return prepared.frame(Purpose::timing); }));
  if (protocol.picture) {
    result.image = prepared.image();
    record.image = image_hash(result.image);
  }
  if (protocol.counters) record.counters = prepared.frame(Purpose::counters).counts;
  record.kernel_hash = prepared.kernel_hash();
  record.outcome = record::Outcome::measured;
  return result;
}

Measurement measure(Prepared& prepared, const Protocol& protocol, technique::Work work_kind,
                    const std::vector<record::ClockTrust>& clocks, const std::string& name,
                    const EnergyMeters* meters) {
  if (!protocol.timed) return untimed(prepared, protocol);
  const Stopwatch whole;
  initialize_benchmarks();
  Measurement result;
  record::Record& record = result.record;
  double work_ns = 0;
  const auto counted = [&work_ns](const auto& work) {
    const Stopwatch stopwatch;
    auto value = work();
    work_ns += stopwatch.ns();
    return value;
  };

  const WarmUp warm = counted([&] { return warm_up(prepared, protocol); });
  record.warm_up_frames = warm.frames;
  record.frames_per_100ms = count_to_fill(100e6, warm.fastest_ns, std::numeric_limits<int>::max());
  record.loop_frames =
      count_to_fill(protocol.least_loop_ns, warm.fastest_ns, protocol.most_loop_frames);

  core::Json entries = time_into(record, prepared, protocol.timed_frames, name, work_ns);
  record.device_clock_trusted =
      is_trusted(work_kind, clocks) && plausible(record.device_ns, record.wall_ns);
  result.image = prepared.image();

  if (protocol.statistics) {
    record.statistics = counted([&] { return prepared.frame(Purpose::statistics); }).counts;
  }
  if (protocol.counters) {
    record.counters = counted([&] { return prepared.frame(Purpose::counters); }).counts;
  }
  const auto draw = [&] { static_cast<void>(prepared.frame(Purpose::timing)); };
  BenchmarkResult loop = time_loop(name + "/loop", record.loop_frames, draw);
  record.loop_wall_ns = loop.total_ns;
  work_ns += loop.total_ns;
  if (meters != nullptr && protocol.has_loop()) {
    record.energy = counted([&] { return meters->of_a_frame(draw); });
  }

  for (core::Json& entry : loop.entries) entries.push_back(std::move(entry));
  add_counts(entries, record.counters);
  add_counts(entries, record.statistics);
  add_counts(entries, {{"device_clock_trusted", record.device_clock_trusted ? 1U : 0U}});
  record.benchmark_json = record::pack_benchmark_entries(entries);
  record.image = image_hash(result.image);
  record.kernel_hash = prepared.kernel_hash();
  record.outcome = record::Outcome::measured;
  record.overhead_ns = whole.ns() - work_ns;
  return result;
}

}  // namespace triptych::measure
