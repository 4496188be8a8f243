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
#include "measure/protocol/frame_proof.hpp"
#include "measure/system/stopwatch.hpp"
#include "record/benchmark_entries.hpp"

namespace triptych::measure {
namespace {

struct WarmUp {
  int frames = 0;
  double fastest_ns = std::numeric_limits<double>::infinity();
};

// Draws the warm-up frames, during which drivers compile code, fault in pages and wake threads.
// Very short frames are repeated beyond the minimum number, until their total time is a tenth of
// the time of the wall-clock loop that follows. The fastest warm-up frame determines how many
// frames the wall-clock loop draws, so that the loop does not end too early.
WarmUp warm_up(FrameProof& proof, const Protocol& protocol) {
  WarmUp result;
  const double target_ns = protocol.least_loop_ns / 10;
  double spent_ns = 0;
  while (result.frames < protocol.warm_up_frames ||
         (spent_ns < target_ns && result.frames < protocol.most_loop_frames)) {
    if (result.frames == 0) proof.start();
    const Stopwatch whole;
    const Frame frame = proof.prepared().frame(Purpose::timing);
    spent_ns += std::max(frame.wall_ns, whole.ns());
    if (result.frames == 0) proof.check("the first frame");
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

// Draws the timed frames, and returns the benchmark's JSON entries. The real time of an entry is
// the wall time, and the device time is an additional key, because whether device times are
// plausible is known only after the last frame. If the device reported no time for one of the
// frames, the record contains no device times, because they could no longer be paired with the wall
// times.
core::Json time_frames_into(record::Record& record, FrameProof& proof, int frames,
                            const std::string& name, double& work_ns) {
  std::vector<std::optional<double>> device_ns;
  record.wall_ns.reserve(static_cast<std::size_t>(frames));
  device_ns.reserve(static_cast<std::size_t>(frames));
  BenchmarkResult result = time_frames(name, frames, [&] {
    proof.start();
    const Stopwatch stopwatch;
    const Frame frame = proof.prepared().frame(Purpose::timing);
    work_ns += stopwatch.ns();
    proof.check(fmt::format("timed frame {} of {}", record.wall_ns.size() + 1, frames));
    const bool has_device_time = frame.device_ns && std::isfinite(*frame.device_ns);
    record.wall_ns.push_back(frame.wall_ns);
    device_ns.push_back(has_device_time ? frame.device_ns : std::nullopt);
    IterationTime time{.ns = frame.wall_ns, .facts = {}};
    if (has_device_time) time.facts["device_ns"] = *frame.device_ns;
    return time;
  });
  if (std::ranges::all_of(device_ns, [](const auto& ns) { return ns.has_value(); })) {
    for (const auto& ns : device_ns) record.device_ns.push_back(*ns);
  }
  return std::move(result.entries);
}

// Adds the counts to the benchmark's JSON entries, except to the entries that describe the spread
// of times (stddev, cv). An entry for a mean or a median has the same counts as an entry for one
// frame, because all frames have the same counts.
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

Measurement measure_untimed(Prepared& prepared, const Protocol& protocol) {
  const Stopwatch whole;
  Measurement result;
  record::Record& record = result.record;
  FrameProof proof(prepared);
  double work_ns = 0;
  const auto draw = [&](Purpose purpose) {
    proof.start();
    const Stopwatch drawing;
    Frame frame = prepared.frame(purpose);
    work_ns += drawing.ns();
    return frame;
  };
  // After a camera jump, cells (groups of particles that are culled together) that were not visible
  // in the previous frame are drawn in another order, so the image may differ.
  const auto check = [&](std::string_view what) {
    if (protocol.camera_jumps) {
      proof.check_drawn(what);
    } else {
      proof.check(what);
    }
  };
  static_cast<void>(draw(Purpose::timing));
  result.image = proof.check("the first frame");
  if (protocol.statistics) {
    record.statistics = draw(Purpose::statistics).counts;
    check("the frame with pipeline statistics");
  }
  if (protocol.counters) {
    record.counters = draw(Purpose::counters).counts;
    proof.check_drawn("the frame with Triptych's counters");
  }
  // Submits the same commands again, because a driver that executes them only the first time would
  // have passed all checks so far.
  static_cast<void>(draw(Purpose::timing));
  check("the second frame");
  record.image = image_hash(result.image);
  record.kernel_hash = prepared.kernel_hash();
  record.outcome = record::Outcome::measured;
  record.overhead_ns = whole.ns() - work_ns;
  return result;
}

}  // namespace

Measurement count_instructions(Prepared& prepared, const Protocol& protocol,
                               const InstructionCounter& counter) {
  constexpr int uncounted_frames = 2;
  FrameProof proof(prepared);
  for (int i = 0; i < uncounted_frames; ++i) {
    proof.renew_reference();
    static_cast<void>(proof.draw(Purpose::timing));
    proof.check(fmt::format("frame {} before the counted frame", i + 1));
  }
  proof.start();
  counter.wait_until_quiet();
  Measurement result;
  record::Record& record = result.record;
  static_cast<void>(counter.count(record.cost, [&] { return prepared.frame(Purpose::timing); }));
  proof.check("the frame whose instructions are counted");
  if (protocol.keep_image) {
    result.image = proof.take_image();
    record.image = image_hash(result.image);
  }
  if (protocol.counters) {
    record.counters = proof.draw(Purpose::counters).counts;
    proof.check_drawn("the frame with Triptych's counters");
  }
  record.kernel_hash = prepared.kernel_hash();
  record.outcome = record::Outcome::measured;
  return result;
}

Measurement measure(Prepared& prepared, const Protocol& protocol, technique::Work work_kind,
                    const std::vector<record::ClockTrust>& clocks, const std::string& name,
                    const EnergyMeters* meters) {
  if (!protocol.timed) return measure_untimed(prepared, protocol);
  const Stopwatch whole;
  initialize_benchmarks();
  Measurement result;
  record::Record& record = result.record;
  double work_ns = 0;
  const auto count_work = [&work_ns](const auto& work) {
    const Stopwatch stopwatch;
    auto value = work();
    work_ns += stopwatch.ns();
    return value;
  };

  FrameProof proof(prepared);
  const WarmUp warm_up_result = count_work([&] { return warm_up(proof, protocol); });
  proof.renew_reference();
  record.warm_up_frames = warm_up_result.frames;
  record.frames_per_100ms =
      count_to_fill(100e6, warm_up_result.fastest_ns, std::numeric_limits<int>::max());
  record.loop_frames =
      count_to_fill(protocol.least_loop_ns, warm_up_result.fastest_ns, protocol.most_loop_frames);

  core::Json entries = time_frames_into(record, proof, protocol.timed_frames, name, work_ns);
  record.device_clock_trusted =
      is_trusted(work_kind, clocks) && plausible(record.device_ns, record.wall_ns);
  result.image = proof.take_image();

  if (protocol.statistics) {
    proof.start();
    record.statistics = count_work([&] { return prepared.frame(Purpose::statistics); }).counts;
    proof.check("the frame with pipeline statistics");
  }
  if (protocol.counters) {
    proof.start();
    record.counters = count_work([&] { return prepared.frame(Purpose::counters); }).counts;
    proof.check_drawn("the frame with Triptych's counters");
  }
  std::vector<double> loop_wall_ns;
  loop_wall_ns.reserve(static_cast<std::size_t>(record.loop_frames));
  const auto draw = [&] { loop_wall_ns.push_back(prepared.frame(Purpose::timing).wall_ns); };
  proof.start();
  BenchmarkResult loop = time_loop(name + "/loop", record.loop_frames, draw);
  record.loop_wall_ns = loop.total_ns;
  work_ns += loop.total_ns;
  if (meters != nullptr && protocol.has_loop()) {
    record.energy = count_work([&] { return meters->energy_per_frame(draw); });
  }
  proof.check("the last frame of the wall-clock loop");
  check_loop(loop_wall_ns, record.wall_ns, [&] {
    const Frame frame = count_work([&] { return proof.draw(Purpose::timing); });
    proof.check("a frame after the wall-clock loop");
    return frame.wall_ns;
  });

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
