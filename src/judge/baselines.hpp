#pragma once
// baselines/<suite>/<plan>/ : what was accepted. Text, sorted, one line per value, so that a change
// can be reviewed. `accept` is the only writer.
//   images/<scene hash>.exr        the truth of each scene as it was accepted, device-independent
//   images.json                    scene → {file, content hash}
//   counters.json                  configuration → counter → value
//   bits/<device key>.json         configuration → {image hash, kernel hash}: same device, same
//   bits statistics/<driver>.json       configuration → statistic → value timings/<device key>.json
//   configuration → one median per accepted run, with clock and kernel hash history.json every
//   accept: date, reason, devices, what changed
// and baselines/waivers.json: device, test, reason, expiry.

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.hpp"
#include "record/store.hpp"

namespace triptych::judge {

struct StoredTiming {
  std::string run;
  double median_ns = 0;
  std::string clock;
  std::string kernel_hash;
};

struct StoredBits {
  std::string image;
  std::string kernel_hash;
};

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
  [[nodiscard]] std::optional<core::Image> image(const std::string& scene) const;
  [[nodiscard]] std::optional<record::Counts> counters(const std::string& configuration) const;
  [[nodiscard]] std::optional<StoredBits> bits(const record::Device& device,
                                               const std::string& configuration) const;
  // nullopt: nothing stored for this driver version at all, or not for this configuration.
  [[nodiscard]] std::optional<record::Counts> statistics(const record::Device& device,
                                                         const std::string& configuration) const;
  [[nodiscard]] std::vector<StoredTiming> timings(const record::Device& device,
                                                  const std::string& configuration) const;
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
  // The truth of a scene, as for the gate.
  std::function<core::Image(const record::Record&)> truth;
};

// Writes what a run measured as the new baselines; returns one line per changed file. Refuses
// (InputError) a blank reason, a run with planted faults, a run that measured nothing. Timings are
// appended (the last 20 runs per device key are kept), everything else is replaced. Each file is
// written aside and renamed, so that a full disk or a kill leaves the old one whole.
[[nodiscard]] std::vector<std::string> accept(const record::Store& store, const std::string& run,
                                              const std::filesystem::path& root,
                                              const AcceptRequest& request);

}  // namespace triptych::judge
