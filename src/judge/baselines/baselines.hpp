#pragma once
// baselines/<suite>/<plan>/ contains the accepted values as sorted text, one value per line, so
// that a change can be reviewed. Only `accept` writes there.
//   manifest.json             the plan's hash and checks, number of configurations in
//                             counters.json, {device id: [drivers]}, [[drivers of one machine]],
//                             {file: content hash} for all files below
//   counters.json             {configuration: {counter: {device id: value}}}
//   memory.json               {configuration: {device id: {kind: bytes}}}
//   cost/<driver>.json        {device, driver_version, counted_by, configurations: {configuration:
//                             {frame: {part: instructions}, prepare: {part: instructions}}}}
//   code/<driver>.json        {device, driver_version, configurations: {configuration: {executable:
//                             {assembly: hash of its disassembly, statistic: value}}}}
//   statistics/<driver>.json  {device, calibration: {statistic: verdict} if it is known,
//                             configurations: {configuration: {statistic: value}}}
//   timings/<device key>.json {device, configurations: {configuration: {clock, median_ns, spread,
//                             frames, kernel_hash}}}, from a single run; only for plans that
//                             check times
//   images.json               {scene: {reference: two hashes, Layout::data_key: content hash of
//                             its data}}
//   images/<scene hash>.exr   the reference image itself; only for plans that check images and
//                             times
//   accuracy.json             {configuration: {device id: {rmse, arithmetic}}}
//   score.json                {configuration: {device id: 0…3}}
//   lacking.json              {driver: [configurations]}: the configurations that this driver
//                             version does not support, although another version of the same device
//                             does
//   history.json              for every `triptych accept`: date, reason, devices, and the hash of
//                             the manifest without its `files`
// <driver> is Device::statistics_key(), which does not depend on the machine. waivers.hpp describes
// baselines/waivers.json.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "accuracy/cases.hpp"
#include "core/image.hpp"
#include "judge/baselines/absent.hpp"
#include "judge/baselines/reference_hash.hpp"
#include "judge/baselines/waivers.hpp"
#include "judge/stress/stress.hpp"
#include "record/store.hpp"

namespace triptych::judge {

struct Manifest {
  std::string plan_hash;
  // The number of configurations in counters.json.
  std::uint64_t configurations = 0;
  std::map<std::string, std::set<std::string>> devices;  // device id → Device::statistics_key()
  std::map<std::string, std::string> files;              // file name → content hash
  record::Checks checks;  // the checks of the plan when it was accepted
  // Sets of drivers that were accepted together on one machine, by Device::statistics_key(). If one
  // driver of a set is found on a machine, all drivers of the set are expected there.
  std::vector<std::set<std::string>> machines;
};

struct StoredTiming {
  std::string clock;
  double median_ns = 0;
  double spread = 0;  // log_spread() of the frame times
  std::string kernel_hash;
};

// The error of the image that a device draws for a configuration, against the scene's limit image
// (the image with exact ray integrals).
struct StoredError {
  double rmse = 0;
  double arithmetic = 0;  // error against the reference image, which uses the same sample positions
};

struct StoredCost {
  record::Counts frame;
  record::Counts prepare;
};

// Everything that is stored about the cost of a driver version.
struct DriverCost {
  std::string device;          // device id
  std::string driver_version;  // as the driver reports it
  std::string counted_by;
  std::map<std::string, StoredCost> configurations;
};

// The stored code statistics of one driver version.
struct DriverCode {
  std::string device;          // device id
  std::string driver_version;  // as the driver reports it
  std::map<std::string, record::Code> configurations;
};

// The values of all counters, by counter and device id.
using StoredCounters = std::map<std::string, std::map<std::string, std::uint64_t>>;

class Baselines {
 public:
  // The folder need not exist. Each file is read when it is first needed; if it is corrupt, the
  // member function that needs it throws InputError with file and line.
  Baselines(std::filesystem::path root, std::string_view plan);

  // Returns whether there are baselines and no file has changed since it was accepted.
  [[nodiscard]] bool present() const;
  // Returns one line about a file that is missing, was edited or does not belong to the baselines.
  // Returns "" if there is no such file.
  [[nodiscard]] const std::string& problem() const;
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const Manifest& manifest() const;
  // Returns the accepted reference image of a scene, or nullopt if no image is stored.
  [[nodiscard]] std::optional<core::Image> image(const std::string& scene) const;
  // Returns the hash of the accepted reference image of a scene, or nullopt if there is none.
  [[nodiscard]] std::optional<ReferenceHash> reference(const std::string& scene) const;
  // Returns the content hash of the data with which the record's scene was accepted, in the
  // record's voxel format, or "" if the hash is not known.
  [[nodiscard]] std::string data_hash(const record::Record& record) const;
  // Returns the counters of all devices, or nullopt if the configuration was never accepted.
  [[nodiscard]] std::optional<StoredCounters> counters(const std::string& configuration) const;
  // Returns whether this device has accepted counters for the configuration.
  [[nodiscard]] bool was_measured(const std::string& device,
                                  const std::string& configuration) const;
  // Returns whether lacking.json lists the configuration for this driver version: it does not
  // support the configuration, although another driver version for the same device does.
  [[nodiscard]] bool lacks(const record::Device& device, const std::string& configuration) const;
  // Returns the allocated bytes by device id. Empty if the configuration was never accepted.
  [[nodiscard]] std::map<std::string, record::Counts> memory(
      const std::string& configuration) const;
  // Returns the errors against the limit image by device id. Empty if the configuration was never
  // accepted.
  [[nodiscard]] std::map<std::string, StoredError> errors(const std::string& configuration) const;
  // Returns the scores of a stress case by device id. Empty if the configuration was never
  // accepted.
  [[nodiscard]] std::map<std::string, std::uint64_t> scores(const std::string& configuration) const;
  // Returns the costs of this driver version, or nullptr if none are stored. The pointer is valid
  // as long as this object exists.
  [[nodiscard]] const DriverCost* cost(const record::Device& device) const;
  // Returns the costs of all driver versions by Device::statistics_key().
  [[nodiscard]] const std::map<std::string, DriverCost>& cost_of_all_drivers() const;
  // Like cost(), but for the code statistics.
  [[nodiscard]] const DriverCode* code(const record::Device& device) const;
  [[nodiscard]] const std::map<std::string, DriverCode>& code_of_all_drivers() const;
  // Returns the stored statistics, or nullopt if nothing is stored for this driver version or for
  // this configuration.
  [[nodiscard]] std::optional<record::Counts> statistics(const record::Device& device,
                                                         const std::string& configuration) const;
  [[nodiscard]] bool has_statistics(const record::Device& device) const;
  // Returns the statistics of the configuration on all stored drivers, by Device::statistics_key().
  [[nodiscard]] std::map<std::string, record::Counts> statistics_of_all_drivers(
      const std::string& configuration) const;
  // Returns the statistics calibration of a stored driver (Device::statistics_calibration), which
  // is empty if the driver was not calibrated. `driver` is its Device::statistics_key().
  [[nodiscard]] std::map<std::string, record::StatisticWorth> statistics_calibration(
      const std::string& driver) const;
  // Returns the times by configuration. Empty if nothing is stored for this device key.
  [[nodiscard]] const std::map<std::string, StoredTiming>& timings(
      const record::Device& device) const;
  // Returns the configurations with stored counters. A complete run must contain all of them.
  [[nodiscard]] std::vector<std::string> configurations() const;
  // Returns the content of waivers.json. `today` is passed to read_waivers().
  [[nodiscard]] const std::vector<Waiver>& waivers(const std::string& today) const;
  // Returns the content of absent.json, which is next to waivers.json and lists the devices that
  // are absent from certain machines on purpose.
  [[nodiscard]] const std::vector<AbsentDevice>& absent_devices() const;
  [[nodiscard]] std::filesystem::path absent_file() const { return root_ / "absent.json"; }
  [[nodiscard]] std::filesystem::path waivers_file() const { return root_ / "waivers.json"; }
  // Returns whether there is a folder for the baselines of a plan, such as "volume/quick".
  [[nodiscard]] bool has_plan(const std::string& plan) const;

 private:
  std::filesystem::path root_;
  std::filesystem::path folder_;
  struct Cache;
  std::shared_ptr<Cache> cache_;
};

// Returns the spread of ln(frame time) over the frames of one run: the median absolute deviation
// times estimation::normal_mad, which equals σ for a normal distribution. The result is at least
// the smallest nonzero difference between two of these logarithms, because the clock may not
// resolve smaller differences. It is also at least 0.5 %, because the medians of two processes that
// run the same program undisturbed differ by that much (docs/how-we-measure.md), and the frames of
// a single process cannot show this difference.
[[nodiscard]] double log_spread(std::vector<double> times_ns);

// Returns the checks of the run's plan. If the run does not store them, returns image, counters,
// statistics, cost, memory and timing.
[[nodiscard]] record::Checks checks_of_run(const record::Run& run);

struct AcceptRequest {
  std::string plan;
  std::string argument = {};      // see GateRequest::argument
  std::string store_option = {};  // see GateRequest::store_option
  std::string reason;             // must not be blank
  std::string only;               // glob for configuration keys; empty: all
  std::string date;               // ISO date
  // If true, stored configurations for which the run has no record are removed, and stored files
  // that have changed since they were accepted are discarded. If false, such a run or such files
  // are an error. If `only` is set as well, the stored values of the configurations that it matches
  // are removed from devices that now skip these configurations.
  bool drop = false;
  // Returns the reference image of a record's scene.
  std::function<core::Image(const record::Record&)> truth;
  // See GateRequest::data_hash.
  std::function<std::string(const record::Record&)> data_hash = {};
  // Returns the limit image of a record's scene, or nullptr if the scene has none. If the function
  // is empty, no errors are stored.
  std::function<const accuracy::LimitImage*(const record::Record&)> limit = {};
  // Used to score every record of the run. nullopt: no scores are stored.
  std::optional<StressTruths> stress = {};
  // Called with the name of each file after the file was written to the new folder. Called with ""
  // after all files were written, before the new folder replaces the old folder.
  std::function<void(const std::string&)> on_written = {};
};

// Writes the measurements of a run as the new baselines. Returns one line for each changed file,
// followed by its changed values ("  PATH: OLD → NEW", at most 40 for each file).
//   - Stores only the values that the checks of the run's plan need.
//   - Throws InputError for a blank reason, a run with injected faults, a run that measured
//     nothing, a run whose data have changed since the measurement, and a run that lacks stored
//     configurations (unless `drop` or `only` is set).
//   - Changes everything or nothing: writes a new folder next to the old folder, and replaces the
//     old folder at the end. Throws IoError if another accept runs at the same time.
[[nodiscard]] std::vector<std::string> accept(const record::Store& store, const std::string& run,
                                              const std::filesystem::path& root,
                                              const AcceptRequest& request);

}  // namespace triptych::judge
