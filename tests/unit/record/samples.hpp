#pragma once
// Sample records for tests, with a value in every field.

#include <limits>
#include <string>

#include "record/record.hpp"

namespace triptych::record {

inline Run sample_run(const std::string& id = "run-1", const std::string& plan = "fake/quick") {
  return {.id = id,
          .plan = plan,
          .started_at = "2024-05-01T12:00:00Z",
          .system = {{"processor", "x86-64"}, {"cores", "2"}}};
}

inline Device sample_device(const std::string& id = "null:scripted") {
  return {.id = id,
          .api = "null",
          .name = "Scripted \"device\"",
          .vendor = "Triptych",
          .driver = "scripted",
          .driver_version = "1.2 (LLVM 15)",
          .api_version = "1",
          .cpu_features = "avx2,fma",
          .environment = {{"LP_NUM_THREADS", "2"}},
          .limits = {{"max_image_3d", "2048"}},
          .statistics_calibration = {{"compute_invocations", {}},
                                     {"fragment_invocations",
                                      {.worth = Worth::inflated, .low = 1.07, .high = 3.9}}},
          .faults = {{.kind = DeviceFaultKind::clock_reads_zero,
                      .subject = "draw",
                      .detail = "0 ns",
                      .last_output = "a warning"}}};
}

inline ClockTrust sample_clock() {
  return {.work = "compute",
          .offered = true,
          .trusted = true,
          .ratio = 0.98,
          .ratio_low = 0.97,
          .ratio_high = 0.99,
          .verdict = "0.98 of the wall clock"};
}

inline Record sample_record(const std::string& configuration = "camera=a,data=b,technique=raycast",
                            const std::string& device = "null:scripted",
                            const std::string& run = "run-1") {
  return {.run = run,
          .suite = "fake",
          .plan = "fake/quick",
          .configuration = configuration,
          .scene = "camera=a,data=b",
          .technique = "raycast",
          .device = device,
          .factors = {{"camera", "a"}, {"data", "b"}, {"step", "0.5"}},
          .outcome = Outcome::measured,
          .reason = {.cause = Cause::same_frames,
                     .stage = Stage::counting,
                     .numbers = {{"limit_s", 60}},
                     .subject = "a call",
                     .code = "A_CODE",
                     .not_tried = true,
                     .shared_levels = "data=b",
                     .detail = "a reason",
                     .last_output = "a warning"},
          .same_as = "camera=random:7,technique=raycast",
          .injected = "a fault",
          .wall_ns = {12.5, 3.25, 1e9, 0.1},
          .device_ns = {12, 3, 0.9e9, 0.05},
          .device_clock_trusted = true,
          .warm_up_frames = 4,
          .frames_per_100ms = 17,
          .loop_wall_ns = 1.1e8,
          .loop_frames = 18,
          .prepare_ns = 5e6,
          .overhead_ns = 6e6,
          .peak_memory_bytes = std::uint64_t{1} << 40,
          .cost = {{"device_code", 123456789}, {"allocations", 3}},
          .prepare_cost = {{"driver", std::uint64_t{1} << 33}},
          .counted_by = "an emulator 7.2",
          .memory = {{"buffers", 4096}},
          .energy = {{"package-0", 1500}},
          .counters = {{"samples", std::numeric_limits<std::uint64_t>::max()}, {"rays_hit", 0}},
          .statistics = {{"compute_invocations", 65536}},
          .image = "0123",
          .data_hash = "4567",
          .kernel_hash = "89ab",
          .precision = {{"filter_weight_error", 1.0 / 512}},
          .benchmark_json = "{\"name\": \"x\"}"};
}

}  // namespace triptych::record
