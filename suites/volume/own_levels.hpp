#pragma once
// Resolves the level `own` of a configuration's factors. For a stress case it means the case's own
// value, for the transfer function of an analytic problem the problem's own one, and for all other
// data the factor's default.

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
  // Whether the stress case decides the value of the factor.
  [[nodiscard]] bool is_stress(const std::string& factor) const {
    return stress_ != nullptr && configuration_.at(factor) == own_level;
  }
  // The factor's value; its default if the value is `own`.
  [[nodiscard]] const std::string& value(const std::string& factor) const;

  const measure::Configuration& configuration_;
  const StressScene* stress_;
};

}  // namespace triptych::volume_suite
