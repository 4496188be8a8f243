#pragma once
// The request of `triptych view` to the program that has the window. Both programs are of one
// build, and the request is its only argument, as JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "measure/contract/suite.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// A device, with variables that are set for its driver ("NAME=VALUE"). So two drivers of one device
// can stand side by side.
struct ViewSide {
  std::string device;
  std::vector<std::string> environment = {};
  bool operator==(const ViewSide&) const = default;
};

struct ViewRequest {
  std::string program;  // the file of `triptych`, which serves the devices
  std::string suite;
  Configuration configuration;
  std::vector<record::Device> devices;  // those of this machine
  std::vector<ViewSide> sides;          // the columns of the window
  std::vector<std::string> faults = {};
  int limit_s = 0;  // for a frame
  std::vector<std::string> data_folders = {};
  int width = 1280;
  int height = 720;
  std::string screenshot = {};  // a file for a picture of the complete window; empty: none
  bool json = false;            // prints what the window shows when it is closed
};

void to_json(nlohmann::json& json, const ViewRequest& request);
void from_json(const nlohmann::json& json, ViewRequest& request);

}  // namespace triptych::measure
