#include "measure/request/view_request.hpp"

#include "core/json.hpp"

namespace triptych::measure {

void to_json(core::Json& json, const ViewRequest& request) {
  core::Json sides = core::Json::array();
  for (const ViewSide& each : request.sides) {
    sides.push_back({{"device", each.device}, {"environment", each.environment}});
  }
  json = {{"program", request.program},
          {"suite", request.suite},
          {"configuration", request.configuration},
          {"devices", request.devices},
          {"sides", std::move(sides)},
          {"faults", request.faults},
          {"limit_s", request.limit_s},
          {"data_folders", request.data_folders},
          {"size", {request.width, request.height}},
          {"screenshot", request.screenshot},
          {"json", request.json}};
}

void from_json(const core::Json& json, ViewRequest& request) {
  json.at("program").get_to(request.program);
  json.at("suite").get_to(request.suite);
  json.at("configuration").get_to(request.configuration);
  json.at("devices").get_to(request.devices);
  request.sides.clear();
  for (const core::Json& each : json.at("sides")) {
    request.sides.push_back({.device = each.at("device"), .environment = each.at("environment")});
  }
  json.at("faults").get_to(request.faults);
  json.at("limit_s").get_to(request.limit_s);
  json.at("data_folders").get_to(request.data_folders);
  json.at("size").at(0).get_to(request.width);
  json.at("size").at(1).get_to(request.height);
  json.at("screenshot").get_to(request.screenshot);
  json.at("json").get_to(request.json);
}

}  // namespace triptych::measure
