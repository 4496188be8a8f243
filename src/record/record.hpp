#pragma once
// Measurements, stored as one Record for each combination of configuration, device and run. The
// judge (src/judge) and the reports need only records, so they also work on a machine that has none
// of the devices.

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/check.hpp"
#include "record/code.hpp"
#include "record/device_fault.hpp"
#include "record/reason.hpp"
#include "record/run_start.hpp"
#include "record/statistic_worth.hpp"

namespace triptych::record {

// Identifies a device. `id` is "<api>:<driver>[#n]".
struct Device {
  std::string id;
  std::string api;   // "opencl", "vulkan", "gl", "null"
  std::string name;  // name of the device, as reported by the driver
  std::string vendor;
  std::string driver;          // name of the driver
  std::string driver_version;  // as reported by the driver, on one line
  std::string api_version;
  std::string cpu_features;  // the CPU features for which code is generated; empty for a GPU
  // The environment variables that affect code generation and that were set.
  std::map<std::string, std::string> environment;
  std::map<std::string, std::string> limits;  // the keys are the API's own names
  // States for each pipeline statistic how exactly the driver counts it. Empty if no calibration
  // scene was drawn. It depends only on the driver, so key() and statistics_key() do not contain
  // it.
  std::map<std::string, StatisticWorth> statistics_calibration = {};
  std::vector<DeviceFault> faults = {};  // not part of any key
  // The GPU family of a compile-only device, such as "navi31": its driver generates code for
  // hardware that is not present, and nothing is ever executed on it. Empty for a device that
  // executes.
  std::string compiles_for = {};

  // Returns a line with everything that determines times and the exact bits of images: id, driver
  // version, API version, environment, and the CPU features or (for a GPU) the name of the
  // hardware. key_hash() returns a short file name that is derived from the key.
  [[nodiscard]] std::string key() const;
  [[nodiscard]] std::string key_hash() const;
  // Returns a key for everything that determines pipeline statistics: id and driver version. The
  // key consists of a readable part and a hash, and can be used as a file name.
  [[nodiscard]] std::string statistics_key() const;
  bool operator==(const Device&) const = default;
};

// States whether the clock of a device is trusted for one kind of work ("compute", "draw"). The
// calibration computes the ratio of device time to wall-clock time for each frame of a workload,
// and stores the median and the range of these ratios.
struct ClockTrust {
  std::string work;
  bool offered = false;  // whether the device reports a time
  bool trusted = false;
  double ratio = 0;  // median of device time / wall-clock time; valid only if `offered`
  double ratio_low = 0;
  double ratio_high = 0;
  std::string verdict;  // the reason for `trusted`, on one line
  bool operator==(const ClockTrust&) const = default;
};

// Counts by name, for example pipeline statistics or instructions. A count that a device cannot
// provide is absent, never zero. The names of the pipeline statistics are input_assembly_vertices,
// input_assembly_primitives, vertex_invocations, geometry_invocations, geometry_primitives,
// clipping_invocations, clipping_primitives, fragment_invocations, tessellation_control_patches,
// tessellation_evaluation_invocations and compute_invocations.
using Counts = std::map<std::string, std::uint64_t>;

struct Record {
  std::string run;  // Run::id of the run to which this record belongs
  std::string suite;
  std::string plan;  // "volume/quick", or the name of the plan's file without extension
  // The key of the configuration: a canonical list "factor=value,…" of technique, data, camera, and
  // all other factors that do not have their default values.
  std::string configuration;
  std::string scene;  // canonical list of the factors that determine the image
  std::string technique;
  std::string device;                          // Device::id
  std::map<std::string, std::string> factors;  // all factors, including defaults

  Outcome outcome = Outcome::failed;
  // The reason for the outcome. Set for every outcome except `measured`, and also for records whose
  // frames were copied.
  Reason reason;
  // The configuration whose frames were copied, because it does the same work in this scene. It
  // belongs to the same run and device. Empty if this configuration itself was measured.
  std::string same_as;
  std::string injected;  // name of an injected fault; such a record is never accepted as a baseline

  // Times in nanoseconds, one for each timed frame. Results are based on the device times if the
  // device's clock is trusted for this kind of work, and otherwise on the wall-clock times.
  std::vector<double> wall_ns;
  std::vector<double> device_ns;  // empty if the device reports no time
  bool device_clock_trusted = false;
  int warm_up_frames = 0;
  int frames_per_100ms = 0;  // number of frames in 100 ms, estimated during warm-up
  // After the timed frames, a loop draws further frames back to back and is timed as a whole. These
  // are the total wall-clock time of this loop and its number of frames.
  double loop_wall_ns = 0;
  int loop_frames = 0;
  double prepare_ns = 0;                // time for loading data, building pipelines and uploading
  double overhead_ns = 0;               // wall-clock time outside device work and warm-up
  std::uint64_t peak_memory_bytes = 0;  // peak memory of the worker process so far

  // The instructions that the worker process executed during one frame, which uses the same device
  // code as the timed frames. They are grouped by the location of the executed code: "device_code",
  // "driver", "libc", "program". Two more entries are "allocations", the number of memory
  // allocations, and "misses", the cache misses of device code in a simulated cache. Empty if
  // instructions were not counted. `prepare_cost` contains the corresponding counts for the
  // preparation.
  Counts cost;
  Counts prepare_cost;
  Code code;  // for plans with the check `code`; empty if the compiler reported nothing
  std::string
      counted_by;   // the emulator that counted `cost`, its version, and the CPU that it simulates
  Counts memory;    // bytes allocated on the device for this configuration, by kind
  Counts energy;    // microjoules per frame, by energy meter; empty if there are no meters
  Counts counters;  // Triptych's own counters; empty if no frame was drawn to count them
  Counts statistics;        // the driver's pipeline statistics
  std::string image;        // content hash, the key for Store::image(); empty without an image
  std::string data_hash;    // content hash of the scene's data
  std::string kernel_hash;  // content hash of the device code
  // Properties of the device that determine the error bound of the image, such as
  // "filter_weight_error".
  std::map<std::string, double> precision;
  std::string benchmark_json;  // Google Benchmark's own output for this configuration

  // Returns whether the configuration was drawn only for its image and its counts, without warm-up
  // and timing. A record that was timed but whose times were lost does not count as untimed.
  [[nodiscard]] bool untimed() const {
    return outcome == Outcome::measured && warm_up_frames == 0 && wall_ns.empty();
  }
  // Returns the number of instructions per frame in device code and in the driver. Unlike the
  // counts of "libc" and "program", this number hardly varies between processes. Returns nullopt if
  // instructions were not counted.
  [[nodiscard]] std::optional<std::uint64_t> instructions() const;
  // Returns the number of bytes that device code loaded into the simulated cache, which has lines
  // of 64 bytes.
  [[nodiscard]] std::optional<std::uint64_t> fetched_bytes() const;
  // time_ns() returns the times on which results are based, and clock() returns the name of the
  // clock that measured them: "device" or "wall".
  [[nodiscard]] const std::vector<double>& time_ns() const;
  [[nodiscard]] const std::vector<double>& time_ns_by(std::string_view clock) const {
    return clock == "wall" ? wall_ns : device_ns;
  }
  [[nodiscard]] std::string_view clock() const;
  // Returns the beginning of all test ids of the plan: "<suite>.<last part of the plan>.".
  [[nodiscard]] std::string test_prefix() const;
  // Returns "<suite>.<last part of the plan>.<check>.<device>", such as
  // volume.quick.image.vulkan:lavapipe.
  [[nodiscard]] std::string test_id(std::string_view check) const;
};

// Returns whether the configuration was skipped because its input is broken. Broken input is not a
// fault of the device, so such a configuration cannot be judged.
[[nodiscard]] inline bool has_bad_input(const Record& record) {
  return record.outcome == Outcome::skipped && record.reason.cause == Cause::bad_input;
}

// Throws NotMeasured for a record that was not measured.
inline void require_measured(const Record& record) {
  if (record.outcome != Outcome::measured) throw NotMeasured(record.outcome, record.reason);
}

// The records of one plan. A run is usually written by one command on one machine. Later commands
// add records to it with --resume, and `triptych merge` combines several runs into one.
struct Run {
  std::string id;  // unique; consists of the time and random digits
  std::string plan;
  std::string started_at;  // ISO 8601, UTC
  // Facts about the machine: CPU, cores, memory, operating system, kernel, compiler, and the
  // version of Triptych.
  std::map<std::string, std::string> system;
  Checks checks = {};                // the checks that the plan lists
  std::string plan_hash = {};        // hash of the plan's YAML
  std::uint64_t configurations = 0;  // number of configurations to be measured on each device
  // One entry for each command that contributed measurements to this run. Empty in a store that was
  // not written by a command.
  std::vector<RunStart> begun = {};
  std::string planned_hash = {};  // hash of the keys that Store::planned() returns
};

// Returns the argument PLAN with which `triptych run` and `triptych compare` select the plan of a
// run. SUITE/PLAN is unchanged. For a plan from a file, the result is FOLDER/NAME.yaml with a
// placeholder for the folder, because only the name of the file is recorded.
[[nodiscard]] std::string plan_argument(const std::string& plan);
// Returns whether the plan is a user's YAML file rather than a plan of a suite.
[[nodiscard]] bool is_plan_file(const std::string& plan);

// Minimum, quartiles, median and maximum of samples, with linear interpolation between order
// statistics. NaN does not count as a sample. summarise() returns nullopt if there are no samples.
struct Summary {
  double minimum, lower_quartile, median, upper_quartile, maximum;
};
[[nodiscard]] std::optional<Summary> summarise(const std::vector<double>& samples);
[[nodiscard]] double percentile(std::vector<double> samples,
                                double share);  // share in [0, 1]; NaN if there are no samples

void to_json(nlohmann::json& json, const Device& device);
void from_json(const nlohmann::json& json, Device& device);
void to_json(nlohmann::json& json, const ClockTrust& trust);
void from_json(const nlohmann::json& json, ClockTrust& trust);
void to_json(nlohmann::json& json, const Record& record);
void from_json(const nlohmann::json& json, Record& record);
void to_json(nlohmann::json& json, const Run& run);
void from_json(const nlohmann::json& json, Run& run);

}  // namespace triptych::record
