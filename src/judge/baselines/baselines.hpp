#pragma once
// baselines/<suite>/<plan>/ : what was accepted. Text, sorted, one line per value, so that a change
// can be reviewed. `accept` is the only writer.
//   images/<scene hash>.exr   the truth of each scene as it was accepted, device-independent
//   images.json               {scene: {file, content hash, content hash of its data}}
//   counters.json             {configuration: {counter: {device id: value}}}
//   bits/<device key>.json    {device, configurations: {configuration: {image hash, kernel hash}}}
//   statistics/<driver>.json  {device, dialect: {statistic: verdict} where it is known,
//                             configurations: {configuration: {statistic: value}}}
//   timings/<device key>.json {device, configurations: {configuration: [{run, median, clock,
//                             kernel hash}, …]}}, one entry per accepted run, oldest first
//   history.json              every accept: date, reason, run, device keys, what changed
//   accuracy.json             {configuration: {device id: {rmse, arithmetic}}}, of SUITE/accuracy
//   score.json                {configuration: {device id: 0…3}}, of SUITE/stress
// and baselines/waivers.json: [{device, test, reason, expiry}, …].

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.hpp"
#include "judge/accuracy/cases.hpp"
#include "judge/stress/stress.hpp"
#include "record/store.hpp"

namespace triptych::judge {

struct StoredTiming {
  std::string run;
  double median_ns = 0;
  std::string clock;
  std::string kernel_hash;
  // By the wall clock, where `clock` is another: what two devices whose own clocks are not both
  // trusted can be compared by. Baselines from before it was kept have none.
  std::optional<double> median_wall_ns = {};

  [[nodiscard]] std::optional<double> median_by(std::string_view which) const {
    if (which == clock) return median_ns;
    return which == "wall" ? median_wall_ns : std::nullopt;
  }
};

// Times by different clocks are not compared: the clock that the record counts by, or the wall
// clock, by which everything is timed, where too few stored runs of its configuration have a time
// by that one and more by this. A clock that a busy machine made doubtful once is no reason to
// judge nothing.
[[nodiscard]] std::string_view common_clock(const record::Record& record,
                                            std::span<const StoredTiming> stored);

// All that is stored of one device's times.
struct StoredDevice {
  std::string id;
  std::string key;                                           // Device::key()
  std::map<std::string, std::vector<StoredTiming>> timings;  // by configuration
};

// Of a configuration on a device: its picture against the limit of its scene.
struct StoredError {
  double rmse = 0;
  double arithmetic = 0;  // against the truth on its own lattice
};

struct StoredBits {
  std::string image;
  std::string kernel_hash;
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

// Counter → device id → value.
using StoredCounters = std::map<std::string, std::map<std::string, std::uint64_t>>;

struct Waiver {
  std::string device;  // glob
  std::string test;    // glob over test ids
  std::string reason;
  std::string expiry;  // ISO date; from that day on it excuses nothing
};

class Baselines {
 public:
  // The folder need not exist: everything is then absent, `present()` is false. Files are read when
  // they are first asked for. Throws InputError with file and line for one that is corrupt.
  Baselines(std::filesystem::path root, std::string_view plan);

  [[nodiscard]] bool present() const;
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  // nullopt also when the file that images.json names is gone; InputError when it is another one.
  [[nodiscard]] std::optional<core::Image> image(const std::string& scene) const;
  // Content hash of the data that the record's scene was accepted with, in the record's voxel
  // format; empty where that is not known.
  [[nodiscard]] std::string data_hash(const record::Record& record) const;
  // Of every device; nullopt: the configuration was never accepted.
  [[nodiscard]] std::optional<StoredCounters> counters(const std::string& configuration) const;
  // By device id; empty: never accepted.
  [[nodiscard]] std::map<std::string, StoredError> errors(const std::string& configuration) const;
  // Likewise: what a stress case scored.
  [[nodiscard]] std::map<std::string, std::uint64_t> scores(const std::string& configuration) const;
  [[nodiscard]] std::optional<StoredBits> bits(const record::Device& device,
                                               const std::string& configuration) const;
  // nullopt: nothing stored for this driver version at all, or not for this configuration.
  [[nodiscard]] std::optional<record::Counts> statistics(const record::Device& device,
                                                         const std::string& configuration) const;
  [[nodiscard]] bool has_statistics(const record::Device& device) const;
  // The same configuration's statistics on every stored driver, by Device::statistics_key().
  [[nodiscard]] std::map<std::string, record::Counts> statistics_of_all_drivers(
      const std::string& configuration) const;
  // Device::statistics_dialect of a stored driver, by Device::statistics_key(); empty where nobody
  // looked.
  [[nodiscard]] std::map<std::string, std::string> statistics_dialect(
      const std::string& driver) const;
  // By Device::statistics_key(). Nothing is read yet.
  [[nodiscard]] std::map<std::string, DriverCost> cost_of_all_drivers() const { return {}; }
  [[nodiscard]] std::vector<StoredTiming> timings(const record::Device& device,
                                                  const std::string& configuration) const;
  // Of every device that was ever accepted, by key.
  [[nodiscard]] std::vector<StoredDevice> timings_of_all_devices() const;
  // The baselines of another plan beside these.
  [[nodiscard]] Baselines of_plan(std::string_view plan) const { return {root_, plan}; }
  // Whether a device with this key was ever accepted.
  [[nodiscard]] bool accepted_before(const record::Device& device) const;
  // Whether the file of its bits, or of its timings, is gone, of which the history tells. A device
  // that was only ever accepted by untimed runs never had timings.
  [[nodiscard]] bool lost_bits(const record::Device& device) const;
  [[nodiscard]] bool lost_timings(const record::Device& device) const;
  // Configurations that have counters stored: what a complete run must hold.
  [[nodiscard]] std::vector<std::string> configurations() const;
  [[nodiscard]] const std::vector<Waiver>& waivers() const;

 private:
  std::filesystem::path root_;
  std::filesystem::path folder_;
  struct Cache;
  std::shared_ptr<Cache> cache_;
};

struct AcceptRequest {
  std::string plan;
  std::string reason;  // must not be blank
  std::string only;    // glob over configuration keys; empty: all
  std::string date;    // ISO
  // Stored configurations that the run has no record of go; else such a run is refused.
  bool drop = false;
  // Drops the times stored before of what was measured, on these device keys: a machine that has
  // changed, or runs made beside other work.
  bool forget_times = false;
  // The truth of a scene, as for the gate.
  std::function<core::Image(const record::Record&)> truth;
  // The limit of a record's scene, nullptr where it has none; nothing: no errors are stored.
  std::function<const LimitPicture*(const record::Record&)> limit = {};
  // Scores every record of the run by both; nothing: no scores are stored.
  std::optional<StressTruths> stress = {};
};

// Writes what a run measured as the new baselines; returns one line per changed file, each followed
// by its changed values ("  PATH: OLD → NEW", the first 40 of a file). Refuses (InputError) a blank
// reason, a run with planted faults, one that measured nothing or holds a part of what is stored
// (see `drop`; with `only` nothing else changes). Timings are appended (the last 20
// runs per device key are kept) unless the old are to be forgotten, everything else is replaced.
// Each file is written aside and renamed, so that a full disk or a kill leaves the old one whole.
[[nodiscard]] std::vector<std::string> accept(const record::Store& store, const std::string& run,
                                              const std::filesystem::path& root,
                                              const AcceptRequest& request);

}  // namespace triptych::judge
