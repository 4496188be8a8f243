#include "measure/contract/factor.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>

#include "core/error.hpp"
#include "core/json.hpp"

namespace triptych::measure {

Factor choice(std::string name, std::vector<std::string> levels, std::string default_value,
              FactorRole role, std::string summary) {
  return {.name = std::move(name),
          .kind = FactorKind::choice,
          .levels = std::move(levels),
          .default_value = std::move(default_value),
          .determines_image = role == FactorRole::scene,
          .summary = std::move(summary)};
}

Factor number(std::string name, double minimum, double maximum, std::string default_value,
              FactorRole role, std::string summary, std::vector<std::string> words) {
  return {.name = std::move(name),
          .kind = FactorKind::number,
          .levels = std::move(words),
          .minimum = minimum,
          .maximum = maximum,
          .default_value = std::move(default_value),
          .determines_image = role == FactorRole::scene,
          .summary = std::move(summary)};
}

Factor text(std::string name, std::string default_value, std::string summary) {
  return {.name = std::move(name),
          .kind = FactorKind::text,
          .levels = {},
          .default_value = std::move(default_value),
          .determines_image = true,
          .summary = std::move(summary)};
}

Factor technique_factor(std::string_view suite, std::string default_value, std::string summary) {
  Factor factor =
      choice("technique", {}, std::move(default_value), FactorRole::method,
             std::move(summary) + "; auto: measure all techniques and report the fastest");
  for (const technique::Technique& each : technique::catalogue()) {
    if (each.suite != suite) continue;
    factor.levels.push_back(each.id);
    if (each.draws_image) factor.automatic.push_back(each.id);
  }
  return factor;
}

std::array<int, 2> parse_viewport(std::string_view value) {
  const auto fail = [&]() {
    return core::InputError(
        fmt::format("viewport '{}': expected N or WxH with 1 to 16384 pixels per side", value));
  };
  const auto side = [&](std::string_view digits) {
    int n = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    if (error != std::errc{} || end != digits.data() + digits.size() || n < 1 || n > 16384)
      throw fail();
    return n;
  };
  const auto cross = value.find('x');
  if (cross == std::string_view::npos) return {side(value), side(value)};
  return {side(value.substr(0, cross)), side(value.substr(cross + 1))};
}

double as_number(const Configuration& configuration, const std::string& factor) {
  return std::strtod(configuration.at(factor).c_str(), nullptr);
}

nlohmann::json camera_json(const scene::Camera& camera) {
  const auto vector = [](const glm::dvec3& v) { return nlohmann::json::array({v.x, v.y, v.z}); };
  return {{"eye", vector(camera.eye)}, {"forward", vector(camera.forward)},
          {"up", vector(camera.up)},   {"fov_y_deg", camera.fov_y_deg},
          {"near", camera.near},       {"far", camera.far}};
}

}  // namespace triptych::measure
