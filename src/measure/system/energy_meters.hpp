#pragma once
// Energy, where the machine tells of it. What a meter counts is the whole part's, its idle share
// and other programs' included.

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
  // What this machine has and this process may read, in microjoules:
  //   package-0, package-0/dram   processors and their memory, by Linux's powercap (RAPL); most
  //                               systems let only root read them
  //   i915-0, xe-0                Intel's graphics cards, by their kernel drivers' hwmon
  //   nvidia-0                    NVIDIA's, by NVML, since Volta
  // `system` and `nvml` are given by tests.
  explicit EnergyMeters(const std::filesystem::path& system = "/sys",
                        const std::filesystem::path& nvml = "libnvidia-ml.so.1");

  [[nodiscard]] std::vector<std::string> names() const;

  // Microjoules of a frame, by meter, over frames drawn one after the other. Meters are renewed
  // only now and then, RAPL's every millisecond, NVIDIA's up to ten times a second. So of each the
  // frames count that lie between two renewals a tenth of a second apart or more. They are drawn
  // until every meter has told that, for a second or three frames, whichever is longer; a meter
  // that has not is absent. Without meters nothing is drawn.
  [[nodiscard]] record::Counts of_a_frame(const std::function<void()>& draw) const;

 private:
  struct Meter {
    std::string name;
    std::function<std::optional<std::uint64_t>()> microjoules;  // since some moment
    std::uint64_t range = 0;  // the count begins anew behind it; 0: never
  };
  class Span;

  void find_processors(const std::filesystem::path& system);
  void add_zone(const std::filesystem::path& zone, const std::string& name);
  void find_intel_cards(const std::filesystem::path& system);
  void find_nvidia_cards(const std::filesystem::path& nvml);

  std::vector<Meter> meters_;
};

}  // namespace triptych::measure
