#pragma once
// Measures energy if the machine has energy meters. A meter measures the energy of a complete
// component, including idle power and the energy used by other programs.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "record/record.hpp"

namespace triptych::measure {

class EnergyMeters {
 public:
  // Finds the meters that this process may read. All values are in microjoules. The meters are:
  //   package-0, package-0/dram   CPUs and their memory, from Linux's powercap interface (RAPL);
  //                               most systems allow only root to read them
  //   i915-0, xe-0                Intel GPUs, from the hwmon interface of their kernel drivers
  //   nvidia-0                    NVIDIA GPUs since Volta, from NVML
  // Tests replace `system` and `nvml`.
  explicit EnergyMeters(const std::filesystem::path& system = "/sys",
                        const std::filesystem::path& nvml = "libnvidia-ml.so.1");

  [[nodiscard]] std::vector<std::string> names() const;

  // Draws frames one after the other, and returns the energy per frame in microjoules for each
  // meter. Meters are updated only at certain intervals: RAPL meters every millisecond, NVIDIA
  // meters up to ten times a second. Therefore the energy is computed for the frames between two
  // updates that are at least a tenth of a second apart. Drawing ends when every meter has had two
  // such updates, but at the latest after one second or three frames, whichever is longer. A meter
  // without two such updates is absent from the result. If there are no meters, nothing is drawn.
  [[nodiscard]] record::Counts energy_per_frame(const std::function<void()>& draw) const;

 private:
  struct Meter {
    std::string name;
    std::function<std::optional<std::uint64_t>()> microjoules;  // counted since an arbitrary time
    std::uint64_t range = 0;  // the count restarts after this value; 0: never
  };
  class Span;

  void find_processors(const std::filesystem::path& system);
  void add_zone(const std::filesystem::path& zone, const std::string& name);
  void find_intel_cards(const std::filesystem::path& system);
  void find_nvidia_cards(const std::filesystem::path& nvml);

  std::vector<Meter> meters_;
};

}  // namespace triptych::measure
