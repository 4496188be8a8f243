#pragma once
// What was measured: one Record per configuration, device and run. Everything above (judge, report)
// works from records alone, on a machine without any of the devices.

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/beginning.hpp"
#include "record/check.hpp"
#include "record/code.hpp"
#include "record/device_fault.hpp"
#include "record/reason.hpp"
#include "record/statistic_worth.hpp"

namespace triptych::record {

// What identifies a device. `id` is "<api>:<driver>[#n]".
struct Device {
  std::string id;
  std::string api;   // "opencl", "vulkan", "gl", "null"
  std::string name;  // as the driver gives it
  std::string vendor;
  std::string driver;          // name of the driver
  std::string driver_version;  // as the driver gives it, on one line
  std::string api_version;
  std::string cpu_features;  // on CPU devices, the features code is generated for; else empty
  std::map<std::string, std::string>
      environment;                            // variables that are set and change code generation
  std::map<std::string, std::string> limits;  // in the API's own names
  // One entry per statistic; empty where no scene was drawn. It depends on the driver alone, so it
  // is not part of any key.
  std::map<std::string, StatisticWorth> statistics_calibration = {};
  std::vector<DeviceFault> faults = {};  // not part of any key either
  // The GPU family, such as "navi31", of a device that only compiles: its driver generates code for
  // hardware that is not here, and nothing is ever executed on it. Empty: the device executes.
  std::string compiles_for = {};

  // id, driver version, API version, CPU features or else the name of the hardware, environment:
  // what timings and bits depend on.
  // One line of text; `key_hash` is a short file name made of it.
  [[nodiscard]] std::string key() const;
  [[nodiscard]] std::string key_hash() const;
  // id and driver version: what pipeline statistics depend on. Also a file name: readable, then a
  // hash.
  [[nodiscard]] std::string statistics_key() const;
  bool operator==(const Device&) const = default;
};

// Trust in a device's clock, per kind of work ("compute", "draw"): device time of a calibration
// workload over its wall-clock time, as median and the range seen.
struct ClockTrust {
  std::string work;
  bool offered = false;  // the device reports a time at all
  bool trusted = false;
  double ratio = 0;  // median of device/wall; meaningless unless offered
  double ratio_low = 0;
  double ratio_high = 0;
  std::string verdict;  // one line, for people
  bool operator==(const ClockTrust&) const = default;
};

// What pipeline statistics may say; a name that a device cannot tell is absent, never zero. Names:
// input_assembly_vertices, input_assembly_primitives, vertex_invocations, geometry_invocations,
// geometry_primitives, clipping_invocations, clipping_primitives, fragment_invocations,
// tessellation_control_patches, tessellation_evaluation_invocations, compute_invocations.
using Counts = std::map<std::string, std::uint64_t>;

struct Record {
  std::string run;  // id of the run (one `triptych run`), see Run
  std::string suite;
  std::string plan;  // "volume/quick" or the file's name
  std::string
      configuration;  // canonical "factor=value,…" of all factors with more than the default
  std::string scene;  // canonical text of the factors that decide the picture
  std::string technique;
  std::string device;                          // Device::id
  std::map<std::string, std::string> factors;  // every factor, defaults resolved

  Outcome outcome = Outcome::failed;
  // For every outcome but measured, and for what was not measured itself.
  Reason reason;
  // The configuration of the same run and device whose frames these are: the scene cannot tell the
  // two apart, and one of them was measured. Empty: this one was.
  std::string same_as;
  std::string injected;  // name of an injected fault; such a record is never accepted as a baseline

  // Times in nanoseconds, one value per timed frame. The clock that counts is device time where it
  // is trusted for this kind of work, else the wall clock.
  std::vector<double> wall_ns;
  std::vector<double> device_ns;  // empty where the device tells no time
  bool device_clock_trusted = false;
  int warm_up_frames = 0;
  int frames_per_100ms = 0;  // as the warm-up found
  double loop_wall_ns = 0;   // the closing wall-clock loop, whole
  int loop_frames = 0;
  double prepare_ns = 0;   // data, pipelines, upload
  double overhead_ns = 0;  // wall clock of this configuration outside device work and warm-up
  std::uint64_t peak_memory_bytes = 0;  // of the worker so far

  // Instructions that the worker executed during one frame of the timed build, by whose memory they
  // lay in: "device_code", "driver", "libc", "program"; "allocations", calls for memory; and
  // "misses" of device code in a simulated cache. Empty unless they were counted. `prepare_cost`:
  // the same of preparing.
  Counts cost;
  Counts prepare_cost;
  Code code;                // of plans that check `code`; empty where no compiler reported any
  std::string counted_by;   // by what: emulator, its version, the processor it shows
  Counts memory;            // bytes allocated on the device for this configuration, by kind
  Counts energy;            // microjoules of a frame, by meter; empty where no meter told it
  Counts counters;          // ours; empty unless a counting frame was made
  Counts statistics;        // the driver's
  std::string image;        // content hash, key of Store::image(); empty when there is none
  std::string data_hash;    // content hash of the scene's data
  std::string kernel_hash;  // content hash of the device code
  std::map<std::string, double> precision;  // facts for the image bound, e.g. "filter_weight_error"
  std::string benchmark_json;  // the entry of Google Benchmark's own output for this configuration

  // Drawn for its picture and what it counts alone: neither warmed up nor timed. A record that was
  // timed and lost its times is none.
  [[nodiscard]] bool untimed() const {
    return outcome == Outcome::measured && warm_up_frames == 0 && wall_ns.empty();
  }
  // Of a frame what repeats from process to process: the device's code and the driver's together.
  // nullopt where none was counted.
  [[nodiscard]] std::optional<std::uint64_t> instructions() const;
  // What the device's code fetched past the simulated cache, whose lines have 64 bytes.
  [[nodiscard]] std::optional<std::uint64_t> fetched_bytes() const;
  // The samples that count, and the name of their clock: "device" or "wall".
  [[nodiscard]] const std::vector<double>& time_ns() const;
  [[nodiscard]] const std::vector<double>& time_ns_by(std::string_view clock) const {
    return clock == "wall" ? wall_ns : device_ns;
  }
  [[nodiscard]] std::string_view clock() const;
  // "<suite>.<plan's last part>.<check>.<device>", e.g. volume.quick.image.vulkan:lavapipe.
  [[nodiscard]] std::string test_id(std::string_view check) const;
};

// Broken input is not the device's fault: its configurations are skipped, and cannot be judged.
[[nodiscard]] inline bool has_bad_input(const Record& record) {
  return record.outcome == Outcome::skipped && record.reason.cause == Cause::bad_input;
}

// Throws NotMeasured for a record that was not.
inline void require_measured(const Record& record) {
  if (record.outcome != Outcome::measured) throw NotMeasured(record.outcome, record.reason);
}

// One `triptych run` on one machine.
struct Run {
  std::string id;  // unique: time and random digits
  std::string plan;
  std::string started_at;  // ISO 8601, UTC
  std::map<std::string, std::string>
      system;          // processor, cores, memory, OS, kernel, compiler, version of Triptych
  Checks checks = {};  // those that its plan is for
  std::string plan_hash = {};        // of the plan's text
  std::uint64_t configurations = 0;  // that it was to measure on each device
  // Of each command that measured for it; empty in a store that no command wrote.
  std::vector<Beginning> begun = {};
  std::string planned_hash = {};  // of the keys of those configurations, Store::planned()
};

// What `triptych run` and `triptych compare` take as PLAN for a run's plan: SUITE/PLAN as it is. A
// plan from a file goes by the file's name without its folder, which nobody recorded.
[[nodiscard]] std::string plan_argument(const std::string& plan);

// Minimum, quartiles, median, maximum of samples (linear interpolation between order statistics);
// absent for none. A sample that is not a number is no sample.
struct Summary {
  double minimum, lower_quartile, median, upper_quartile, maximum;
};
[[nodiscard]] std::optional<Summary> summarise(const std::vector<double>& samples);
[[nodiscard]] double percentile(std::vector<double> samples,
                                double share);  // share in [0, 1]; samples not empty

void to_json(nlohmann::json& json, const Device& device);
void from_json(const nlohmann::json& json, Device& device);
void to_json(nlohmann::json& json, const ClockTrust& trust);
void from_json(const nlohmann::json& json, ClockTrust& trust);
void to_json(nlohmann::json& json, const Record& record);
void from_json(const nlohmann::json& json, Record& record);
void to_json(nlohmann::json& json, const Run& run);
void from_json(const nlohmann::json& json, Run& run);

}  // namespace triptych::record
