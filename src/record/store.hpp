#pragma once
// The store is one SQLite file (in WAL mode) with runs, devices and their clocks, records with
// every raw sample, and images. Each record is appended in its own transaction, so a run that is
// killed loses at most the record in flight. docs/store.md describes the tables and has example
// queries.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.hpp"
#include "record/record.hpp"

namespace triptych::record {

// The reference image of a scene, with a bound for each pixel on the difference of a device's
// image.
struct TruthImage {
  std::string scene;
  std::string version;           // of the renderer and its error model; an image of
                                 // another version is rendered again
  std::vector<std::byte> image;  // EXR
  std::vector<std::byte> bound;  // EXR, the same in every channel
  std::string own_seal = {};     // see measure/truth/own_seal.hpp; empty if the origin is unknown
};

class Store {
 public:
  static constexpr int schema_version = 7;
  enum class Mode { read, append };  // append creates the file if it is missing

  // Throws IoError if the file cannot be opened or written or the disk is full, and InputError if
  // the file is not a store or has another schema version; the error states both versions and what
  // to do. Every call waits up to `busy_limit` for another process that is writing, and then throws
  // IoError. A call that writes also throws it if the file was removed or renamed. `file` is always
  // the name of a file, even if SQLite would give it another meaning; an empty name is rejected. A
  // store in a read-only folder can be read, unless its writer was killed there, because the log
  // then contains the last records and cannot be replayed. Only one thread may use a Store at a
  // time.
  Store(const std::filesystem::path& file, Mode mode,
        std::chrono::milliseconds busy_limit = std::chrono::seconds(10));
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const;

  // Throws InputError if SQLite finds that the file is damaged. Call this before judging anything.
  // It reads the whole file once.
  void require_whole() const;

  // Adds a run, or replaces one with the same id. The functions below throw InputError for devices
  // and records of a run that was not added.
  void add_run(const Run& run);
  // Returns the latest run of the plan. If there is none, adds this run and returns it. If several
  // processes call this at once, one adds its run and the others find it.
  [[nodiscard]] Run latest_run_or_add(const Run& run);
  // States that a command begins to measure these configurations for the run, which must exist.
  // This is flushed to the disk immediately, so that a reader can see what is missing from a run
  // that was cut short.
  void begin(const std::string& run, const Beginning& beginning,
             std::span<const std::string> configurations);
  void add_device(const std::string& run, const Device& device,
                  const std::vector<ClockTrust>& clocks);
  void add_image(std::string_view hash,
                 std::span<const std::byte> exr);  // known hashes are not written again
  void add_record(
      const Record& record);  // replaces the record of the same run, configuration and device
  // States that a configuration is about to be measured. When this returns, everything that was
  // stored so far is on the disk, because the measurement may crash the machine. Returns the number
  // of such calls since a record of the configuration was last added, including this one.
  // unbegin_record() takes one call back, for a run that the user interrupted.
  int begin_record(const std::string& run, const std::string& configuration,
                   const std::string& device);
  void unbegin_record(const std::string& run, const std::string& configuration,
                      const std::string& device);
  void set_truth(const TruthImage& truth);
  // Adds a disassembly, which records refer to by its content hash. Keeps an existing one.
  void add_listing(std::string_view hash, std::string_view text);

  [[nodiscard]] std::vector<Run> runs() const;  // oldest first
  [[nodiscard]] std::optional<Run> latest_run(std::string_view plan) const;
  // The keys of all configurations that the run was to measure, sorted. Throws InputError if they
  // are not the ones that were stored when the run began.
  [[nodiscard]] std::vector<std::string> planned(const Run& run) const;
  // The keys of the configurations that the run has a record of on this device.
  [[nodiscard]] std::set<std::string> configurations(std::string_view run,
                                                     std::string_view device) const;
  struct DeviceEntry {
    Device device;
    std::vector<ClockTrust> clocks;
  };
  [[nodiscard]] std::vector<DeviceEntry> devices(std::string_view run) const;
  [[nodiscard]] std::vector<Record> records(
      std::string_view run) const;  // by device, then in the order in which they were added
  // Visits the records in the order in which they were added, with one record in memory at a time,
  // because a store may be larger than the memory. An exception from `visit` stops the iteration.
  void visit_records(std::string_view run, const std::function<void(const Record&)>& visit) const;
  // The names of the values in one of these tables ("factor", "cost", …) for the run's records.
  [[nodiscard]] std::set<std::string> names(std::string_view run, std::string_view table) const;
  [[nodiscard]] std::uint64_t count_records(std::string_view run, std::string_view device) const;
  [[nodiscard]] bool has_record(std::string_view run, std::string_view configuration,
                                std::string_view device) const;
  [[nodiscard]] std::vector<std::byte> image(
      std::string_view hash) const;  // throws InputError if unknown
  // The same image, decoded. Throws InputError with the names of the store and the image if it is
  // not a usable EXR file.
  [[nodiscard]] core::Image picture(std::string_view hash) const;
  [[nodiscard]] std::optional<TruthImage> truth(std::string_view scene,
                                                std::string_view version) const;
  // The disassembly with this hash; nullopt if the store has none.
  [[nodiscard]] std::optional<std::string> listing(std::string_view hash) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The latest run of each plan, sorted by the names of the plans.
[[nodiscard]] std::vector<Run> latest_runs(const Store& store);

}  // namespace triptych::record
