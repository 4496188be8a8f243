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
//   statistics/<driver>.json  {device, calibration: {statistic: verdict} where it is known,
//                             configurations: {configuration: {statistic: value}}}
//   timings/<device key>.json {device, configurations: {configuration: {clock, median_ns, spread,
//                             frames, kernel_hash}}}, from a single run; only for plans that
//                             check times
//   images.json               {scene: {reference: two hashes, data…: content hash of its data}}
//   images/<scene hash>.exr   the reference image itself; only for plans that check images and
//                             times
//   accuracy.json             {configuration: {device id: {rmse, arithmetic}}}
//   score.json                {configuration: {device id: 0…3}}
//   lacking.json              {driver: [configurations]} that this driver version does not support,
//                             although another version of the same device does
//   history.json              for every accept: date, reason, devices, and the hash of the manifest
//                             without its `files`
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
  std::uint64_t configurations = 0;                      // in counters.json
  std::map<std::string, std::set<std::string>> devices;  // device id → Device::statistics_key()
  std::map<std::string, std::string> files;              // name → content hash
  record::Checks checks;  // the checks of the plan when it was accepted
  // Drivers that were accepted on one machine, by Device::statistics_key(). If one of them is
  // found, the others are expected.
  std::vector<std::set<std::string>> machines;
};

struct StoredTiming {
  std::string clock;
  double median_ns = 0;
  double spread = 0;  // log_spread() of its frames
  std::string kernel_hash;
};

// The error of a configuration on a device: its image compared with the limit of its scene.
struct StoredError {
  double rmse = 0;
  double arithmetic = 0;  // the error against the reference image on its own lattice
};

struct StoredCost {
  record::Counts frame;
  record::Counts prepare;
};

// Everything that is stored about the cost of a driver version.
struct DriverCost {
  std::string device;          // id
  std::string driver_version;  // as the driver reports it
  std::string counted_by;
  std::map<std::string, StoredCost> configurations;
};

// The stored code statistics of one driver version.
struct DriverCode {
  std::string device;          // id
  std::string driver_version;  // as the driver gives it
  std::map<std::string, record::Code> configurations;
};

// Counter → device id → value.
using StoredCounters = std::map<std::string, std::map<std::string, std::uint64_t>>;

class Baselines {
 public:
  // The folder need not exist. A file is read when it is first needed. Throws InputError with file
  // and line if it is corrupt.
  Baselines(std::filesystem::path root, std::string_view plan);

  // Whether there are baselines, and every file is as it was accepted.
  [[nodiscard]] bool present() const;
  // One line about a file that is missing, was edited or does not belong to the baselines; empty if
  // all files are as they were accepted.
  [[nodiscard]] const std::string& problem() const;
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const Manifest& manifest() const;
  // nullopt if no image is stored.
  [[nodiscard]] std::optional<core::Image> image(const std::string& scene) const;
  // The hash of the reference image that was accepted; nullopt if there is none.
  [[nodiscard]] std::optional<ReferenceHash> reference(const std::string& scene) const;
  // The content hash of the data with which the record's scene was accepted, in the record's voxel
  // format; empty if it is not known.
  [[nodiscard]] std::string data_hash(const record::Record& record) const;
  // The counters of every device; nullopt if the configuration was never accepted.
  [[nodiscard]] std::optional<StoredCounters> counters(const std::string& configuration) const;
  // Whether this device has accepted counters for the configuration.
  [[nodiscard]] bool was_measured(const std::string& device,
                                  const std::string& configuration) const;
  // Whether this driver version was accepted without the configuration, because it does not support
  // it, although another version of the device does.
  [[nodiscard]] bool lacks(const record::Device& device, const std::string& configuration) const;
  // By device id.
  [[nodiscard]] std::map<std::string, record::Counts> memory(
      const std::string& configuration) const;
  // By device id; empty if the configuration was never accepted.
  [[nodiscard]] std::map<std::string, StoredError> errors(const std::string& configuration) const;
  // The scores of a stress case, by device id; empty if the configuration was never accepted.
  [[nodiscard]] std::map<std::string, std::uint64_t> scores(const std::string& configuration) const;
  // The costs of this driver version; nullptr if none are stored. Valid as long as this object.
  [[nodiscard]] const DriverCost* cost(const record::Device& device) const;
  // By Device::statistics_key().
  [[nodiscard]] const std::map<std::string, DriverCost>& cost_of_all_drivers() const;
  // The code statistics, as for cost().
  [[nodiscard]] const DriverCode* code(const record::Device& device) const;
  [[nodiscard]] const std::map<std::string, DriverCode>& code_of_all_drivers() const;
  // nullopt if nothing is stored for this driver version, or not for this configuration.
  [[nodiscard]] std::optional<record::Counts> statistics(const record::Device& device,
                                                         const std::string& configuration) const;
  [[nodiscard]] bool has_statistics(const record::Device& device) const;
  // The statistics of the configuration on every stored driver, by Device::statistics_key().
  [[nodiscard]] std::map<std::string, record::Counts> statistics_of_all_drivers(
      const std::string& configuration) const;
  // Device::statistics_calibration of each stored driver, by Device::statistics_key(); empty for
  // one that was not calibrated.
  [[nodiscard]] std::map<std::string, record::StatisticWorth> statistics_calibration(
      const std::string& driver) const;
  // By configuration; empty if nothing is stored for this device key.
  [[nodiscard]] const std::map<std::string, StoredTiming>& timings(
      const record::Device& device) const;
  // Configurations with stored counters: a complete run must contain them.
  [[nodiscard]] std::vector<std::string> configurations() const;
  // The content of waivers.json; `today` as for read_waivers().
  [[nodiscard]] const std::vector<Waiver>& waivers(const std::string& today) const;
  // The content of absent.json, which is next to waivers.json: the devices that machines lack on
  // purpose.
  [[nodiscard]] const std::vector<Absent>& absent() const;
  [[nodiscard]] std::filesystem::path absent_file() const { return root_ / "absent.json"; }

 private:
  std::filesystem::path root_;
  std::filesystem::path folder_;
  struct Cache;
  std::shared_ptr<Cache> cache_;
};

// The spread of ln t over the frames of one run: 1.4826 times their median absolute deviation,
// which is σ for a normal distribution. It is at least one step of the clock. It is also at least
// 0.5 %, because the medians of two undisturbed process runs of the same program differ by that
// much (docs/how-we-measure.md), which the frames of one process cannot show.
[[nodiscard]] double log_spread(std::vector<double> times_ns);

// The checks of the run's plan. For a run that does not store them, the checks that apply to every
// plan.
[[nodiscard]] record::Checks checked_in(const record::Run& run);

struct AcceptRequest {
  std::string plan;
  std::string argument = {};      // as in GateRequest
  std::string store_option = {};  // as in GateRequest
  std::string reason;             // must not be blank
  std::string only;               // glob over configuration keys; empty: all
  std::string date;               // ISO
  // If true, stored configurations without a record in the run are removed, and so are stored files
  // that have changed since they were accepted. If false, such a run or such files are refused.
  // With `only`, the stored values of a configuration are removed if the device now skips it.
  bool drop = false;
  // The reference image of a scene, as for the gate.
  std::function<core::Image(const record::Record&)> truth;
  // As GateRequest::data_hash.
  std::function<std::string(const record::Record&)> data_hash = {};
  // The limit of a record's scene, nullptr if it has none. An empty function: no errors are stored.
  std::function<const accuracy::LimitPicture*(const record::Record&)> limit = {};
  // With these, every record of the run is scored. nullopt: no scores are stored.
  std::optional<StressTruths> stress = {};
  // Called with the name of each file after it was written next to the old folder, and then with ""
  // when all are written and nothing has taken effect yet.
  std::function<void(const std::string&)> on_written = {};
};

// Writes the measurements of a run as the new baselines. Returns one line for each changed file,
// followed by its changed values (" PATH: OLD → NEW", the first 40 of a file). Throws InputError
// for a blank reason, a run with injected faults, a run that measured nothing, a run that contains
// only a part of what is stored (see `drop`; with `only` nothing else changes), and a run on other
// data than there are now. Only what the run's plan checks is stored. Either everything changes or
// nothing: the new folder is written next to the old one and replaces it at the end. A second
// accept at the same time throws IoError.
[[nodiscard]] std::vector<std::string> accept(const record::Store& store, const std::string& run,
                                              const std::filesystem::path& root,
                                              const AcceptRequest& request);

}  // namespace triptych::judge
