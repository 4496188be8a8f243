#include "suites/volume/own_levels.hpp"

#include <algorithm>

#include "measure/contract/factor.hpp"
#include "suites/volume/analytic_data.hpp"
#include "suites/volume/factors.hpp"

namespace triptych::volume_suite {

const std::string& OwnLevels::value(const std::string& factor) const {
  const std::string& given = configuration_.at(factor);
  return given == own_level
             ? std::ranges::find(volume_factors(), factor, &measure::Factor::name)->default_value
             : given;
}

double OwnLevels::step() const {
  return is_stress("step") ? stress_->step_voxels
                           : measure::as_number({{"step", value("step")}}, "step");
}

double OwnLevels::ert() const {
  return is_stress("ert") ? stress_->ert : measure::as_number({{"ert", value("ert")}}, "ert");
}

double OwnLevels::adapt() const {
  return measure::as_number(configuration_, "adapt");
}

bool OwnLevels::shaded() const {
  return is_stress("shading") ? stress_->shaded : value("shading") == "gradient";
}

scene::Quadrature OwnLevels::quadrature() const {
  if (is_stress("quadrature")) return stress_->quadrature;
  return scene::quadrature(value("quadrature"));
}

std::array<int, 2> OwnLevels::viewport() const {
  if (is_stress("viewport")) return {stress_->width, stress_->height};
  return measure::parse_viewport(value("viewport"));
}

scene::Camera OwnLevels::camera(const scene::Box& box) const {
  if (is_stress("camera")) return stress_->camera;
  return scene::camera_at(value("camera"), box, field_of_view);
}

scene::TransferFunction OwnLevels::transfer_function(
    const std::vector<std::filesystem::path>& folders) const {
  const std::string& name = configuration_.at("transfer_function");
  if (name != own_level) return scene::load_transfer_function(name, folders);
  if (stress_ != nullptr) return stress_->function;
  const auto analytic = analytic_data(configuration_.at("data"));
  return analytic ? analytic_transfer_function(*analytic)
                  : scene::load_transfer_function("surfaces");
}

std::array<float, 4> OwnLevels::background() const {
  return stress_ != nullptr ? stress_->background : std::array<float, 4>{};
}

}  // namespace triptych::volume_suite
