#include "core/json.hpp"

#include <algorithm>

#include "accuracy/cases.hpp"

namespace triptych::accuracy {
namespace {

using core::Json;

Json optional_number(const auto& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json case_json(const AccuracyCase& each, bool front) {
  return {{"configuration", each.configuration},
          {"time_ns", optional_number(each.time_ns)},
          {"samples", optional_number(each.samples)},
          {"instructions", optional_number(each.instructions)},
          {"fetched_bytes", optional_number(each.fetched)},
          {"memory_bytes", optional_number(each.memory)},
          {"joules", optional_number(each.joules)},
          {"rmse", each.rmse},
          {"largest", each.largest},
          {"error_99", each.error_99},
          {"lattice", each.lattice},
          {"arithmetic", each.arithmetic},
          {"front", front}};
}

Json family_json(const AccuracyFamily& family, const std::vector<AccuracyCase>& cases) {
  Json members = Json::array();
  for (const std::size_t i : family.members) members.push_back(cases[i].configuration);
  return {{"name", family.name},
          {"order", family.order ? Json(family.order->order) : Json(nullptr)},
          {"half_width", family.order ? Json(family.order->half_width) : Json(nullptr)},
          {"configurations", std::move(members)}};
}

}  // namespace

Json to_json(const AccuracyScene& scene) {
  Json cases = Json::array();
  for (std::size_t i = 0; i < scene.cases.size(); ++i) {
    const bool front = std::ranges::find(scene.front, i) != scene.front.end();
    cases.push_back(case_json(scene.cases[i], front));
  }
  Json families = Json::array();
  for (const AccuracyFamily& family : scene.families) {
    families.push_back(family_json(family, scene.cases));
  }
  return {{"device", scene.device},
          {"scene", scene.scene},
          {"data", scene.data},
          {"uncertainty", scene.uncertainty},
          {"representation", optional_number(scene.representation)},
          {"eight_bits", scene.eight_bit_error},
          {"nothing", scene.empty_image_error},
          {"hypervolume", scene.area ? Json(scene.area->area) : Json(nullptr)},
          {"configurations", std::move(cases)},
          {"families", std::move(families)}};
}

}  // namespace triptych::accuracy
