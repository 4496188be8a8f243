#pragma once
// baselines/<suite>/<plan>/ : what was accepted. Text, sorted, one value per line, so that a change
// can be reviewed. `accept` is the only writer.
//   manifest.json             the plan's hash and checks, number of configurations, {device id:
//                             [drivers]}, [[drivers of one machine]], {file: content hash} of all that follows
//   counters.json             {configuration: {counter: {device id: value}}}
//   memory.json               {configuration: {device id: {kind: bytes}}}
//   cost/<driver>.json        {device, driver_version, counted_by, configurations: {configuration:
//                             {frame: {part: instructions}, prepare: likewise}}}
//   code/<driver>.json        {device, driver_version, configurations: {configuration: {executable:
//                             {assembly: hash of its disassembly, statistic: value}}}}
//   statistics/<driver>.json  {device, calibration: {statistic: verdict} where it is known,
//                             configurations: {configuration: {statistic: value}}}
//   timings/<device key>.json {device, configurations: {configuration: {clock, median_ns, spread,
//                             frames, kernel_hash}}}, of one run; of plans that check times
//   images.json               {scene: {reference: two hashes, data…: content hash of its data}}
//   images/<scene hash>.exr   the reference itself, of plans that check images and times
//   accuracy.json             {configuration: {device id: {rmse, arithmetic}}}
//   score.json                {configuration: {device id: 0…3}}
//   history.json              every accept: date, reason, devices
// <driver> is Device::statistics_key(): no machine is in it. And baselines/waivers.json
// (waivers.hpp).

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
  std::uint64_t configurations = 0;
  std::map<std::string, std::set<std::string>> devices;  // id → Device::statistics_key()
  std::map<std::string, std::string> files;              // name → content hash
  record::Checks checks;                                 // of the plan as it was accepted
  // Drivers that were accepted on one machine, by Device::statistics_key(): where one of them is
  // found, the others are expected.
  std::vector<std::set<std::string>> machines;
};

struct StoredTiming {
  std::string clock;
  double median_ns = 0;
  double spread = 0;  // log_spread() of its frames
  std::string kernel_hash;
};

// Of a configuration on a device: its picture against the limit of its scene.
struct StoredError {
  double rmse = 0;
  double arithmetic = 0;  // against the truth on its own lattice
};

struct StoredCost {
  record::Counts frame;
  record::Counts prepare;
};

// All that is stored of a driver version's cost.
struct DriverCost {
  std::string device;          // id
  std::string driver_version;  // as the driver gives it
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
  // The folder need not exist. Files are read when they are first asked for. Throws InputError with
  // file and line for one that is corrupt.
  Baselines(std::filesystem::path root, std::string_view plan);

  // They are there, and every file is as it was accepted.
  [[nodiscard]] bool present() const;
  // Of what is there, which file is gone, edited or not of it; one line, empty where none is.
  [[nodiscard]] const std::string& problem() const;
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const Manifest& manifest() const;
  // nullopt where none is kept.
  [[nodiscard]] std::optional<core::Image> image(const std::string& scene) const;
  // Of the reference as it was accepted; nullopt: the scene never was.
  [[nodiscard]] std::optional<ReferenceHash> reference(const std::string& scene) const;
  // Content hash of the data that the record's scene was accepted with, in the record's voxel
  // format; empty where that is not known.
  [[nodiscard]] std::string data_hash(const record::Record& record) const;
  // Of every device; nullopt: the configuration was never accepted.
  [[nodiscard]] std::optional<StoredCounters> counters(const std::string& configuration) const;
  // Whether this device counted anything in it.
  [[nodiscard]] bool was_measured(const std::string& device,
                                  const std::string& configuration) const;
  // By device id.
  [[nodiscard]] std::map<std::string, record::Counts> memory(
      const std::string& configuration) const;
  // By device id; empty: never accepted.
  [[nodiscard]] std::map<std::string, StoredError> errors(const std::string& configuration) const;
  // Likewise: what a stress case scored.
  [[nodiscard]] std::map<std::string, std::uint64_t> scores(const std::string& configuration) const;
  // Of this driver version; nullptr: nothing is stored. Lives as long as these Baselines.
  [[nodiscard]] const DriverCost* cost(const record::Device& device) const;
  // By Device::statistics_key().
  [[nodiscard]] const std::map<std::string, DriverCost>& cost_of_all_drivers() const;
  // Likewise.
  [[nodiscard]] const DriverCode* code(const record::Device& device) const;
  [[nodiscard]] const std::map<std::string, DriverCode>& code_of_all_drivers() const;
  // nullopt: nothing stored for this driver version at all, or not for this configuration.
  [[nodiscard]] std::optional<record::Counts> statistics(const record::Device& device,
                                                         const std::string& configuration) const;
  [[nodiscard]] bool has_statistics(const record::Device& device) const;
  // The same configuration's statistics on every stored driver, by Device::statistics_key().
  [[nodiscard]] std::map<std::string, record::Counts> statistics_of_all_drivers(
      const std::string& configuration) const;
  // Device::statistics_calibration of a stored driver, by Device::statistics_key(); empty where
  // nobody looked.
  [[nodiscard]] std::map<std::string, record::StatisticWorth> statistics_calibration(
      const std::string& driver) const;
  // By configuration; empty: nothing stored of this device key.
  [[nodiscard]] const std::map<std::string, StoredTiming>& timings(
      const record::Device& device) const;
  // Configurations that have counters stored: what a complete run must hold.
  [[nodiscard]] std::vector<std::string> configurations() const;
  [[nodiscard]] const std::vector<Waiver>& waivers() const;
  // absent.json beside waivers.json: devices that machines are meant to lack.
  [[nodiscard]] const std::vector<Absent>& absent() const;
  [[nodiscard]] std::filesystem::path absent_file() const { return root_ / "absent.json"; }

 private:
  // What the manifest says of the files, and is not so; empty where all is.
  [[nodiscard]] std::string contradiction() const;

  std::filesystem::path root_;
  std::filesystem::path folder_;
  struct Cache;
  std::shared_ptr<Cache> cache_;
};

// Half the width of ln t of one run's frames: 1.4826 of their median absolute deviation, a normal
// distribution's σ, but no less than one step of the clock, nor than what the medians of two quiet
// process runs of the same program differ by, 0.5 % (docs/how-we-measure.md), which the frames of
// one cannot show.
[[nodiscard]] double log_spread(std::vector<double> times_ns);

// The checks of the run's plan; of a run that keeps none, what every plan can be held to.
[[nodiscard]] record::Checks checked_in(const record::Run& run);

struct AcceptRequest {
  std::string plan;
  std::string argument = {};      // as of GateRequest
  std::string store_option = {};  // likewise
  std::string reason;             // must not be blank
  std::string only;               // glob over configuration keys; empty: all
  std::string date;               // ISO
  // Stored configurations that the run has no record of go, and so does what is not as it was
  // accepted; else such a run or such files are refused. With `only`: what is stored of
  // configurations goes where their device skips them now.
  bool drop = false;
  // The truth of a scene, as for the gate.
  std::function<core::Image(const record::Record&)> truth;
  // As GateRequest::data_hash.
  std::function<std::string(const record::Record&)> data_hash = {};
  // The limit of a record's scene, nullptr where it has none; nothing: no errors are stored.
  std::function<const accuracy::LimitPicture*(const record::Record&)> limit = {};
  // Scores every record of the run by both; nothing: no scores are stored.
  std::optional<StressTruths> stress = {};
  // Told of each file that lies aside, then of "" when all do and nothing has taken effect yet.
  std::function<void(const std::string&)> on_written = {};
};

// Writes what a run measured as the new baselines; returns one line per changed file, each followed
// by its changed values ("  PATH: OLD → NEW", the first 40 of a file). Refuses (InputError) a blank
// reason, a run with injected faults, one that measured nothing, holds a part of what is stored
// (see `drop`; with `only` nothing else changes), or was measured on other data than there are now.
// What is kept is what the run's plan checks. All or nothing: the new folder is written beside the
// old one and takes its place at the end. One accept at a time, else IoError.
[[nodiscard]] std::vector<std::string> accept(const record::Store& store, const std::string& run,
                                              const std::filesystem::path& root,
                                              const AcceptRequest& request);

}  // namespace triptych::judge
