#pragma once
// What a configuration's factors say where they may be `own`: a stress case's, an analytic
// problem's transfer function, and for all other data the factor's default.

#include <array>
#include <filesystem>
#include <vector>

#include "measure/contract/suite.hpp"
#include "scene/volume_scene.hpp"
#include "suites/volume/stress_cases.hpp"

namespace triptych::volume_suite {

// Of one configuration, whose data is `stress`, or no stress case where that is nullptr. Both must
// outlive it.
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
  // Whether the stress case decides the factor.
  [[nodiscard]] bool is_stress(const std::string& factor) const {
    return stress_ != nullptr && configuration_.at(factor) == own_level;
  }
  // The factor's value, its default where it is `own`.
  [[nodiscard]] const std::string& value(const std::string& factor) const;

  const measure::Configuration& configuration_;
  const StressScene* stress_;
};

}  // namespace triptych::volume_suite
