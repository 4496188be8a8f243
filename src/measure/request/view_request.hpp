#pragma once
// The request that `triptych view` sends to the program that displays the window. Both programs
// come from the same build. The request is passed in JSON format, as the only argument of the
// second program.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "measure/contract/suite.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// A device, and the environment variables ("NAME=VALUE") that are set for its driver. By using
// different variables, the window can show two drivers of one device side by side.
struct ViewSide {
  std::string device;
  std::vector<std::string> environment = {};
  bool operator==(const ViewSide&) const = default;
};

struct ViewRequest {
  std::string program;  // the path of `triptych`, whose workers use the devices
  std::string suite;
  Configuration configuration;
  std::vector<record::Device> devices;  // all devices of this machine
  std::vector<ViewSide> sides;          // shown as the columns of the window
  std::vector<std::string> faults = {};
  int limit_s = 0;  // time limit for a frame, in seconds
  std::vector<std::string> data_folders = {};
  int width = 1280;
  int height = 720;
  std::string screenshot = {};  // file for an image of the whole window; empty: none
  bool json = false;            // print the values in the window as JSON when it is closed
};

void to_json(nlohmann::json& json, const ViewRequest& request);
void from_json(const nlohmann::json& json, ViewRequest& request);

}  // namespace triptych::measure
