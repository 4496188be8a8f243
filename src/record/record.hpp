#pragma once
// The measurements: one Record for each configuration, device and run. The judge and the reports
// work from records only, on a machine without any of the devices.

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
  std::string cpu_features;  // features that code is generated for; empty for a GPU
  // The environment variables that are set and change code generation.
  std::map<std::string, std::string> environment;
  std::map<std::string, std::string> limits;  // with the API's own names
  // One entry for each statistic; empty if no calibration scene was drawn. The calibration depends
  // only on the driver, so it is not part of any key.
  std::map<std::string, StatisticWorth> statistics_calibration = {};
  std::vector<DeviceFault> faults = {};  // not part of any key
  // The GPU family of a compile-only device, such as "navi31": its driver generates code for
  // hardware that is not present, and nothing is ever executed on it. Empty for a device that
  // executes.
  std::string compiles_for = {};

  // Everything that the times and the bits of images depend on: id, driver version, API version,
  // environment, and the CPU features or otherwise the name of the hardware. The key is one line of
  // text; `key_hash` is a short file name that is computed from it.
  [[nodiscard]] std::string key() const;
  [[nodiscard]] std::string key_hash() const;
  // Everything that pipeline statistics depend on: id and driver version. The key is also a file
  // name, which consists of a readable part and a hash.
  [[nodiscard]] std::string statistics_key() const;
  bool operator==(const Device&) const = default;
};

// Whether the clock of a device is trusted, for one kind of work ("compute", "draw"). The ratio is
// the device time of a calibration workload divided by its wall-clock time, as the median and the
// range.
struct ClockTrust {
  std::string work;
  bool offered = false;  // whether the device reports a time
  bool trusted = false;
  double ratio = 0;  // median of device/wall; valid only if offered
  double ratio_low = 0;
  double ratio_high = 0;
  std::string verdict;  // one line of text
  bool operator==(const ClockTrust&) const = default;
};

// The pipeline statistics. A statistic that a device cannot count is absent, never zero. The names
// are input_assembly_vertices, input_assembly_primitives, vertex_invocations, geometry_invocations,
// geometry_primitives, clipping_invocations, clipping_primitives, fragment_invocations,
// tessellation_control_patches, tessellation_evaluation_invocations and compute_invocations.
using Counts = std::map<std::string, std::uint64_t>;

struct Record {
  std::string run;  // Run::id of the command `triptych run` that made this record
  std::string suite;
  std::string plan;  // "volume/quick", or the name of the plan's file
  std::string
      configuration;  // canonical "factor=value,…" of all factors that do not have their defaults
  std::string scene;  // canonical text of the factors that determine the image
  std::string technique;
  std::string device;                          // Device::id
  std::map<std::string, std::string> factors;  // every factor; defaults are resolved

  Outcome outcome = Outcome::failed;
  // The reason for every outcome except measured, and for records with copied frames.
  Reason reason;
  // The configuration of the same run and device from which the frames were copied, because both
  // configurations are the same work in this scene. Empty if this configuration itself was
  // measured.
  std::string same_as;
  std::string injected;  // name of an injected fault; such a record is never accepted as a baseline

  // Times in nanoseconds, one for each timed frame. The device time is used if it is trusted for
  // this kind of work, otherwise the wall clock.
  std::vector<double> wall_ns;
  std::vector<double> device_ns;  // empty if the device reports no time
  bool device_clock_trusted = false;
  int warm_up_frames = 0;
  int frames_per_100ms = 0;  // estimated during warm-up
  double loop_wall_ns = 0;   // the whole wall-clock loop at the end
  int loop_frames = 0;
  double prepare_ns = 0;                // time for data, pipelines and upload
  double overhead_ns = 0;               // wall-clock time outside device work and warm-up
  std::uint64_t peak_memory_bytes = 0;  // peak of the worker process so far

  // The instructions that the worker executed during one frame of the timed build, grouped by the
  // memory that contains them: "device_code", "driver", "libc", "program". There are also
  // "allocations", the number of memory allocations, and "misses" of device code in a simulated
  // cache. Empty if instructions were not counted. `prepare_cost` contains the same for the
  // preparation.
  Counts cost;
  Counts prepare_cost;
  Code code;  // for plans that check `code`; empty if no compiler reported any
  std::string
      counted_by;  // the counter: the emulator, its version, and the processor that it simulates
  Counts memory;            // bytes allocated on the device for this configuration, by kind
  Counts energy;            // microjoules per frame, by meter; empty if there are no meters
  Counts counters;          // Triptych's own counters; empty if no counting frame was drawn
  Counts statistics;        // the driver's pipeline statistics
  std::string image;        // content hash, the key for Store::image(); empty without an image
  std::string data_hash;    // content hash of the scene's data
  std::string kernel_hash;  // content hash of the device code
  // Facts that determine the bound of the image, such as "filter_weight_error".
  std::map<std::string, double> precision;
  std::string benchmark_json;  // the entry of Google Benchmark's own output for this configuration

  // Whether the configuration was drawn only for its image and its counts, without warm-up and
  // timing. A record that was timed but lost its times does not count as untimed.
  [[nodiscard]] bool untimed() const {
    return outcome == Outcome::measured && warm_up_frames == 0 && wall_ns.empty();
  }
  // The instructions of a frame that are the same in every process: those of the device code and of
  // the driver. nullopt if none were counted.
  [[nodiscard]] std::optional<std::uint64_t> instructions() const;
  // The number of bytes that device code fetched because they were not in the simulated cache,
  // whose lines have 64 bytes.
  [[nodiscard]] std::optional<std::uint64_t> fetched_bytes() const;
  // The times of the clock that is used, and the name of that clock: "device" or "wall".
  [[nodiscard]] const std::vector<double>& time_ns() const;
  [[nodiscard]] const std::vector<double>& time_ns_by(std::string_view clock) const {
    return clock == "wall" ? wall_ns : device_ns;
  }
  [[nodiscard]] std::string_view clock() const;
  // The form is "<suite>.<last part of the plan>.<check>.<device>", such as
  // volume.quick.image.vulkan:lavapipe.
  [[nodiscard]] std::string test_id(std::string_view check) const;
};

// Whether the input was broken. That is not the device's fault, so such configurations are skipped
// and cannot be judged.
[[nodiscard]] inline bool has_bad_input(const Record& record) {
  return record.outcome == Outcome::skipped && record.reason.cause == Cause::bad_input;
}

// Throws NotMeasured for a record that was not measured.
inline void require_measured(const Record& record) {
  if (record.outcome != Outcome::measured) throw NotMeasured(record.outcome, record.reason);
}

// One execution of the command `triptych run` on one machine.
struct Run {
  std::string id;  // unique, made of the time and random digits
  std::string plan;
  std::string started_at;  // ISO 8601, UTC
  // Processor, cores, memory, operating system, kernel, compiler, and version of Triptych.
  std::map<std::string, std::string> system;
  Checks checks = {};                // the checks of its plan
  std::string plan_hash = {};        // hash of the plan's text
  std::uint64_t configurations = 0;  // number to be measured on each device
  // One entry for each command that measured for this run. Empty in a store that no command wrote.
  std::vector<Beginning> begun = {};
  std::string planned_hash = {};  // hash of the keys of those configurations (Store::planned())
};

// The argument PLAN of `triptych run` and `triptych compare` that selects the plan of a run.
// SUITE/PLAN is used as it is. For a plan from a file, only the name of the file is known, because
// its folder is not recorded.
[[nodiscard]] std::string plan_argument(const std::string& plan);

// Minimum, quartiles, median and maximum of samples (with linear interpolation between order
// statistics); nullopt if there are no samples. NaN does not count as a sample.
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
