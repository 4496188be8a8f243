#pragma once
// Measures energy if the machine has meters. A meter counts the energy of a whole component,
// including its idle power and the energy that other programs use.

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
  // Finds the meters of this machine that this process may read, in microjoules:
  //   package-0, package-0/dram   processors and their memory, from Linux's powercap (RAPL); most
  //                               systems allow only root to read them
  //   i915-0, xe-0                Intel's GPUs, from their kernel drivers' hwmon
  //   nvidia-0                    NVIDIA's GPUs since Volta, from NVML
  // Tests set `system` and `nvml`.
  explicit EnergyMeters(const std::filesystem::path& system = "/sys",
                        const std::filesystem::path& nvml = "libnvidia-ml.so.1");

  [[nodiscard]] std::vector<std::string> names() const;

  // Returns the microjoules per frame for each meter, measured while frames are drawn one after the
  // other. Meters are updated only from time to time: RAPL's every millisecond, NVIDIA's up to ten
  // times a second. For each meter, the frames between two updates that are at least a tenth of a
  // second apart are used. Frames are drawn until every meter has had such updates, but for at most
  // a second or three frames, whichever is longer; a meter without such updates is absent. Without
  // meters nothing is drawn.
  [[nodiscard]] record::Counts of_a_frame(const std::function<void()>& draw) const;

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
