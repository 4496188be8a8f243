#pragma once
// The list of techniques. It is defined in catalogue.json, which CMake reads, too.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::technique {

// The kind of device work that a frame of the technique consists of. Clocks are calibrated for each
// kind.
enum class Work : std::uint8_t { compute, draw };
[[nodiscard]] std::string_view name_of(Work work);

struct Technique {
  std::string id;     // also the file stem in every backend's folder
  std::string suite;  // "volume" or "particles"
  Work work = Work::compute;
  bool picture = true;  // draws the scene; false for a bound on speed, whose image is meaningless
  std::vector<std::string> apis;  // the APIs on which the technique exists
  std::string summary;
};

[[nodiscard]] const std::vector<Technique>& catalogue();
[[nodiscard]] const Technique& technique(
    std::string_view id);  // throws InputError with the known names

}  // namespace triptych::technique
