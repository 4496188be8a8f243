#pragma once
// The store is a single SQLite file (in WAL mode) that contains runs, devices and their clocks,
// records with every raw sample, and images. Each record is appended in its own transaction, so a
// run that is killed loses at most the record that it was about to write. docs/store.md describes
// the tables and shows example queries.

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

// The reference image of a scene, with a bound for each pixel. The bound limits the difference
// between the reference image and a device's image.
struct TruthImage {
  std::string scene;
  std::string version;  // version of the reference renderer and its error model; an image from
                        // another version is rendered again
  std::vector<std::byte> image;  // EXR
  std::vector<std::byte> bound;  // EXR with equal values in all channels
  // A keyed hash that proves that this user rendered the image (measure/truth/own_seal.hpp). Empty
  // if no key was available.
  std::string own_seal = {};
};

class Store {
 public:
  static constexpr int schema_version = 7;
  enum class Mode { read, append };  // append creates the file if it is missing

  // Opens the store. Throws IoError if the file cannot be opened or written, or if the disk is
  // full. Throws InputError if the file is not a store or has another schema version; the message
  // states both versions and what to do. `file` is always a file name, even if it has a special
  // meaning in SQLite, such as ":memory:". An empty name is rejected.
  //
  // If another process is writing, every call waits up to `busy_limit` and then throws IoError. A
  // call that writes also throws IoError if the file was removed or renamed. Only one thread may
  // use a Store at a time.
  //
  // A store in a read-only folder can be read unless the process that wrote it was killed. In that
  // case, the latest records are still in the log, which cannot be replayed in such a folder.
  Store(const std::filesystem::path& file, Mode mode,
        std::chrono::milliseconds busy_limit = std::chrono::seconds(10));
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const;

  // Throws InputError if SQLite finds that the file is damaged. Call this function before judging
  // any records. It reads the whole file once.
  void require_whole() const;

  // Adds a run, or replaces the run with the same id. The functions below throw InputError if the
  // run of a device or record was not added.
  void add_run(const Run& run);
  // Returns the latest run of the plan. If there is none, adds `run` and returns it. If several
  // processes call this function at the same time, one of them adds its run and all others return
  // that run.
  [[nodiscard]] Run latest_run_or_add(const Run& run);
  // Records that a command is about to measure these configurations for the run, which must exist.
  // The entry is flushed to the disk immediately. If the run is interrupted, a reader can therefore
  // determine which records are missing.
  void begin(const std::string& run, const RunStart& start,
             std::span<const std::string> configurations);
  void add_device(const std::string& run, const Device& device,
                  const std::vector<ClockTrust>& clocks);
  void add_image(std::string_view hash,
                 std::span<const std::byte> exr);  // does nothing if the hash exists
  void add_record(
      const Record& record);  // replaces the record of the same run, configuration and device
  // Records that a configuration is about to be measured. When this function returns, everything
  // that was stored so far is on the disk, because the measurement may crash the machine. Returns
  // how often the measurement was begun, including this time, since a record of the configuration
  // was last added; a number above 1 means that earlier attempts never finished. unbegin_record()
  // reverts one call if the user interrupted the run.
  int begin_record(const std::string& run, const std::string& configuration,
                   const std::string& device);
  void unbegin_record(const std::string& run, const std::string& configuration,
                      const std::string& device);
  void set_truth(const TruthImage& truth);
  // Adds a disassembly. Records refer to it by its content hash. Does nothing if the hash exists.
  void add_listing(std::string_view hash, std::string_view text);

  [[nodiscard]] std::vector<Run> runs() const;  // oldest first
  [[nodiscard]] std::optional<Run> latest_run(std::string_view plan) const;
  // Returns the sorted keys of all configurations that the run was supposed to measure. Throws
  // InputError if this list was changed after it was stored.
  [[nodiscard]] std::vector<std::string> planned(const Run& run) const;
  // Returns the keys of the configurations for which the run has a record on this device.
  [[nodiscard]] std::set<std::string> configurations(std::string_view run,
                                                     std::string_view device) const;
  struct DeviceEntry {
    Device device;
    std::vector<ClockTrust> clocks;
  };
  [[nodiscard]] std::vector<DeviceEntry> devices(std::string_view run) const;
  [[nodiscard]] std::vector<Record> records(
      std::string_view run) const;  // sorted by device, then by the order of addition
  // Visits the records in the order in which they were added. Keeps only one record in memory at a
  // time, because a store may be larger than the memory. An exception from `visit` stops the
  // iteration.
  void visit_records(std::string_view run, const std::function<void(const Record&)>& visit) const;
  // Returns all names that occur in `table` for the records of the run. `table` must be a table of
  // names and values, such as "factor" or "cost".
  [[nodiscard]] std::set<std::string> names(std::string_view run, std::string_view table) const;
  [[nodiscard]] bool has_record(std::string_view run, std::string_view configuration,
                                std::string_view device) const;
  [[nodiscard]] std::vector<std::byte> image(
      std::string_view hash) const;  // throws InputError if there is none
  // Returns the decoded image. If it is not a usable EXR file, throws an InputError that names the
  // store and the image.
  [[nodiscard]] core::Image decoded_image(std::string_view hash) const;
  [[nodiscard]] std::optional<TruthImage> truth(std::string_view scene,
                                                std::string_view version) const;
  // Returns the disassembly with this hash, or nullopt if the store does not contain it.
  [[nodiscard]] std::optional<std::string> listing(std::string_view hash) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Returns the latest run of each plan, sorted by plan name.
[[nodiscard]] std::vector<Run> latest_runs(const Store& store);

}  // namespace triptych::record
