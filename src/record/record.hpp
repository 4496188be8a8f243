#pragma once
// The measurements: one Record for each configuration, device and run. Everything above (judge,
// report) works from records only, on a machine without any of the devices.

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

// Identifies a device. `id` is "<api>:<driver>[#n]".
struct Device {
  std::string id;
  std::string api;   // "opencl", "vulkan", "gl", "null"
  std::string name;  // as the driver reports it
  std::string vendor;
  std::string driver;          // name of the driver
  std::string driver_version;  // as the driver reports it, on one line
  std::string api_version;
  std::string cpu_features;  // the features for which code is generated; empty for a GPU
  // Variables that are set and change code generation.
  std::map<std::string, std::string> environment;
  std::map<std::string, std::string> limits;  // in the API's own names
  // One entry for each statistic; empty if no scene was drawn. It depends only on the driver, so it
  // is not a part of any key.
  std::map<std::string, StatisticWorth> statistics_calibration = {};
  std::vector<DeviceFault> faults = {};  // not part of any key either
  // The GPU family, such as "navi31", of a device that only compiles: its driver generates code for
  // hardware that is not here, and nothing is ever executed on it. Empty: the device executes.
  std::string compiles_for = {};

  // Everything that times and the bits of images depend on: id, driver version, API version, CPU
  // features or otherwise the name of the hardware, and environment. It is one line of text;
  // `key_hash` is a short file name that is computed from it.
  [[nodiscard]] std::string key() const;
  [[nodiscard]] std::string key_hash() const;
  // Everything that pipeline statistics depend on: id and driver version. It is also a file name: a
  // readable part and a hash.
  [[nodiscard]] std::string statistics_key() const;
  bool operator==(const Device&) const = default;
};

// Whether the clock of a device is trusted, for each kind of work ("compute", "draw"): the device
// time of a calibration workload divided by its wall-clock time, as the median and the range.
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

// The pipeline statistics. One that a device cannot count is absent, never zero. Names:
// input_assembly_vertices, input_assembly_primitives, vertex_invocations, geometry_invocations,
// geometry_primitives, clipping_invocations, clipping_primitives, fragment_invocations,
// tessellation_control_patches, tessellation_evaluation_invocations, compute_invocations.
using Counts = std::map<std::string, std::uint64_t>;

struct Record {
  std::string run;  // id of the run (one command `triptych run`), see Run
  std::string suite;
  std::string plan;  // "volume/quick" or the file's name
  std::string
      configuration;  // canonical "factor=value,…" of all factors that do not have their defaults
  std::string scene;  // canonical text of the factors that determine the image
  std::string technique;
  std::string device;                          // Device::id
  std::map<std::string, std::string> factors;  // every factor; defaults are resolved

  Outcome outcome = Outcome::failed;
  // Set for every outcome except measured, and for records that copied their frames.
  Reason reason;
  // The configuration of the same run and device whose frames these are: in this scene both are the
  // same work, and the other one was measured. Empty: this one was measured.
  std::string same_as;
  std::string injected;  // name of an injected fault; such a record is never accepted as a baseline

  // Times in nanoseconds, one for each timed frame. Device time is used if it is trusted for this
  // kind of work, otherwise the wall clock.
  std::vector<double> wall_ns;
  std::vector<double> device_ns;  // empty if the device reports no time
  bool device_clock_trusted = false;
  int warm_up_frames = 0;
  int frames_per_100ms = 0;  // estimated during warm-up
  double loop_wall_ns = 0;   // the whole wall-clock loop at the end
  int loop_frames = 0;
  double prepare_ns = 0;   // data, pipelines, upload
  double overhead_ns = 0;  // wall clock of this configuration outside device work and warm-up
  std::uint64_t peak_memory_bytes = 0;  // peak of the worker process so far

  // Instructions that the worker executed during one frame of the timed build, by the memory in
  // which they were: "device_code", "driver", "libc", "program". Also "allocations", which are
  // calls for memory, and "misses" of device code in a simulated cache. Empty if they were not
  // counted. `prepare_cost` is the same for preparing.
  Counts cost;
  Counts prepare_cost;
  Code code;                // of plans that check `code`; empty where no compiler reported any
  std::string
      counted_by;  // the counter: the emulator, its version, and the processor that it simulates
  Counts memory;            // bytes allocated on the device for this configuration, by kind
  Counts energy;            // microjoules per frame, by meter; empty if there are no meters
  Counts counters;          // Triptych's own counters; empty if no counting frame was drawn
  Counts statistics;        // the driver's
  std::string image;        // content hash, the key for Store::image(); empty if there is none
  std::string data_hash;    // content hash of the scene's data
  std::string kernel_hash;  // content hash of the device code
  // Facts for the bound of the image, e.g. "filter_weight_error".
  std::map<std::string, double> precision;
  std::string benchmark_json;  // the entry of Google Benchmark's own output for this configuration

  // Drawn only for its image and its counts, so neither warmed up nor timed. A record that was
  // timed and lost its times does not count as untimed.
  [[nodiscard]] bool untimed() const {
    return outcome == Outcome::measured && warm_up_frames == 0 && wall_ns.empty();
  }
  // The instructions of a frame that repeat from process to process: those of the device code and
  // of the driver. nullopt if none were counted.
  [[nodiscard]] std::optional<std::uint64_t> instructions() const;
  // The bytes that device code fetched because they were not in the simulated cache, whose lines
  // have 64 bytes.
  [[nodiscard]] std::optional<std::uint64_t> fetched_bytes() const;
  // The times that are used, and the name of their clock: "device" or "wall".
  [[nodiscard]] const std::vector<double>& time_ns() const;
  [[nodiscard]] const std::vector<double>& time_ns_by(std::string_view clock) const {
    return clock == "wall" ? wall_ns : device_ns;
  }
  [[nodiscard]] std::string_view clock() const;
  // "<suite>.<plan's last part>.<check>.<device>", e.g. volume.quick.image.vulkan:lavapipe.
  [[nodiscard]] std::string test_id(std::string_view check) const;
};

// Broken input is not the device's fault: the configurations are skipped and cannot be judged.
[[nodiscard]] inline bool has_bad_input(const Record& record) {
  return record.outcome == Outcome::skipped && record.reason.cause == Cause::bad_input;
}

// Throws NotMeasured for a record that was not measured.
inline void require_measured(const Record& record) {
  if (record.outcome != Outcome::measured) throw NotMeasured(record.outcome, record.reason);
}

// One command `triptych run` on one machine.
struct Run {
  std::string id;  // unique: time and random digits
  std::string plan;
  std::string started_at;  // ISO 8601, UTC
  // Processor, cores, memory, OS, kernel, compiler, version of Triptych.
  std::map<std::string, std::string> system;
  Checks checks = {};                // the checks of its plan
  std::string plan_hash = {};        // hash of the plan's text
  std::uint64_t configurations = 0;  // the number that it was to measure on each device
  // One for each command that measured for this run; empty in a store that no command wrote.
  std::vector<Beginning> begun = {};
  std::string planned_hash = {};  // hash of the keys of those configurations, Store::planned()
};

// The argument PLAN of `triptych run` and `triptych compare` for a run's plan: SUITE/PLAN is used
// as it is. A plan from a file is known by the name of the file without its folder, which is not
// recorded.
[[nodiscard]] std::string plan_argument(const std::string& plan);

// Minimum, quartiles, median and maximum of samples (linear interpolation between order
// statistics); nullopt if there are none. NaN does not count as a sample.
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
