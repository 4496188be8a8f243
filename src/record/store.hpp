#pragma once
// The store: one SQLite file (WAL) holding runs, devices with their clocks, records with every raw
// sample, and images. Records are appended in their own transaction as they are made, so a killed
// run loses at most the one in flight. The tables and example queries are in docs/store.md.

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

// A reference picture of a scene with the bound per pixel within which a device's picture must lie.
struct TruthImage {
  std::string scene;
  std::string version;  // of the renderer and its error model; another version is rendered anew
  std::vector<std::byte> image;  // EXR
  std::vector<std::byte> bound;  // EXR, the same in every channel
  std::string own_seal = {};     // measure/truth/own_seal.hpp; empty: anybody may have drawn it
};

class Store {
 public:
  static constexpr int schema_version = 7;
  enum class Mode { read, append };  // append creates the file when it is missing

  // Throws IoError (cannot open, read-only, disk full) and InputError (not a store, or of another
  // schema version: says which one it is, which one is expected and what to do). Every call waits
  // up to `busy_limit` for another process that is writing, then throws IoError; so does one that
  // writes when the file was removed or renamed meanwhile. `file` names a file, whatever SQLite
  // would take the name for; an empty one is refused. A store in a read-only folder can be read
  // unless its writer was killed there: its log, which then holds the last records, cannot be
  // replayed. One Store is used by one thread at a time.
  Store(const std::filesystem::path& file, Mode mode,
        std::chrono::milliseconds busy_limit = std::chrono::seconds(10));
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const;

  // Throws InputError where SQLite finds the file damaged: to be asked before anything is judged by
  // it. Reads all of the file once.
  void require_whole() const;

  // What is already there under the same key is replaced. Devices and records of a run that was not
  // added are refused with InputError.
  void add_run(const Run& run);
  // The latest run of the plan, or where there is none this one, now added. Of several processes
  // that ask at once one adds, the others find its run.
  [[nodiscard]] Run latest_run_or_add(const Run& run);
  // A command begins to measure these configurations for the run, which has to be there: at once
  // kept on the disk, so that a run that is cut short afterwards says what it lacks.
  void begin(const std::string& run, const Beginning& beginning,
             std::span<const std::string> configurations);
  void add_device(const std::string& run, const Device& device,
                  const std::vector<ClockTrust>& clocks);
  void add_image(std::string_view hash,
                 std::span<const std::byte> exr);  // known hashes are left alone
  void add_record(
      const Record& record);  // replaces the one of the same run, configuration and device
  // A record of `run` is about to be made. Kept on the disk, with all that was stored before, when
  // this returns: what is begun may take the machine down. Returns how often it was begun since a
  // record of it was last added, this time included. unbegin_record() takes one time back, as of a
  // run that somebody interrupted.
  int begin_record(const std::string& run, const std::string& configuration,
                   const std::string& device);
  void unbegin_record(const std::string& run, const std::string& configuration,
                      const std::string& device);
  void set_truth(const TruthImage& truth);
  // A disassembly, which records name by its content hash; known ones are left alone.
  void add_listing(std::string_view hash, std::string_view text);

  [[nodiscard]] std::vector<Run> runs() const;  // oldest first
  [[nodiscard]] std::optional<Run> latest_run(std::string_view plan) const;
  // Keys of all configurations that the run was to measure, sorted. Throws InputError where they
  // are not those that it began with.
  [[nodiscard]] std::vector<std::string> planned(const Run& run) const;
  // Keys of those that the run has a record of on the device.
  [[nodiscard]] std::set<std::string> configurations(std::string_view run,
                                                     std::string_view device) const;
  struct DeviceEntry {
    Device device;
    std::vector<ClockTrust> clocks;
  };
  [[nodiscard]] std::vector<DeviceEntry> devices(std::string_view run) const;
  [[nodiscard]] std::vector<Record> records(
      std::string_view run) const;  // by device, then as added
  // The same in the order in which they were added, one in memory at a time: a store may hold more
  // than memory does. What `visit` throws ends it.
  void visit_records(std::string_view run, const std::function<void(const Record&)>& visit) const;
  // The names of values that the run's records have in a table of these: "factor", "cost", …
  [[nodiscard]] std::set<std::string> names(std::string_view run, std::string_view table) const;
  [[nodiscard]] std::uint64_t count_records(std::string_view run, std::string_view device) const;
  [[nodiscard]] bool has_record(std::string_view run, std::string_view configuration,
                                std::string_view device) const;
  [[nodiscard]] std::vector<std::byte> image(
      std::string_view hash) const;  // throws InputError if unknown
  // The same, decoded; InputError naming store and image where it is no usable EXR.
  [[nodiscard]] core::Image picture(std::string_view hash) const;
  [[nodiscard]] std::optional<TruthImage> truth(std::string_view scene,
                                                std::string_view version) const;
  // The disassembly with this hash; nullopt where the store has none.
  [[nodiscard]] std::optional<std::string> listing(std::string_view hash) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The latest run of each plan, by the plans' names.
[[nodiscard]] std::vector<Run> latest_runs(const Store& store);

}  // namespace triptych::record
