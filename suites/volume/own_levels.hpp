#pragma once
// Resolves the level `own` of a configuration's factors. For a stress case, it selects the value
// that the case defines. For the transfer function of an analytic problem, it selects the function
// that the problem defines. For all other data, it selects the factor's default.

#include <array>
#include <filesystem>
#include <vector>

#include "measure/contract/suite.hpp"
#include "scene/volume_scene.hpp"
#include "suites/volume/stress_cases.hpp"

namespace triptych::volume_suite {

// The levels of one configuration. `stress` is its stress case, or nullptr if its data are not a
// stress case. Both must outlive this object.
class OwnLevels {
 public:
  OwnLevels(const measure::Configuration& configuration, const StressScene* stress)
      : configuration_(configuration), stress_(stress) {}

  [[nodiscard]] double step() const;
  [[nodiscard]] double ert() const;
  [[nodiscard]] double adapt() const;
  [[nodiscard]] bool shaded() const;
  [[nodiscard]] scene::Quadrature quadrature() const;
  [[nodiscard]] std::array<int, 2> viewport() const;
  [[nodiscard]] scene::Camera camera(const scene::Box& box) const;
  [[nodiscard]] scene::TransferFunction transfer_function(
      const std::vector<std::filesystem::path>& folders) const;
  [[nodiscard]] std::array<float, 4> background() const;

 private:
  // Returns whether the stress case defines the value of the factor.
  [[nodiscard]] bool is_stress(const std::string& factor) const {
    return stress_ != nullptr && configuration_.at(factor) == own_level;
  }
  // Returns the factor's level, or its default if the level is `own`.
  [[nodiscard]] const std::string& value(const std::string& factor) const;

  const measure::Configuration& configuration_;
  const StressScene* stress_;
};

}  // namespace triptych::volume_suite
