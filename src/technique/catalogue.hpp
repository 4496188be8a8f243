#pragma once
// The techniques there are. The list itself is catalogue.json, which CMake reads too.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::technique {

// The kind of device work a technique's frame consists of; clocks are calibrated for each.
enum class Work : std::uint8_t { compute, draw };
[[nodiscard]] std::string_view name_of(Work work);

struct Technique {
  std::string id;     // also the file stem in every backend's folder
  std::string suite;  // "volume" or "particles"
  Work work = Work::compute;
  bool picture = true;  // draws the scene; false for a bound on speed, whose image means nothing
  std::vector<std::string> apis;  // where the technique exists at all
  std::string summary;
};

[[nodiscard]] const std::vector<Technique>& catalogue();
[[nodiscard]] const Technique& technique(
    std::string_view id);  // throws InputError, naming those there are

}  // namespace triptych::technique
