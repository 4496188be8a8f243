#pragma once
// Shared by the commands that draw one configuration on one device.

#include <string>
#include <vector>

#include "app/arguments.hpp"
#include "app/registry.hpp"

namespace triptych::app {

struct FrameArguments {
  std::string suite = {};
  std::string device = {};
  std::vector<std::string> set = {};
  std::string out = {};
  std::vector<std::string> faults = {};

  bool chooses = false;    // "auto" may stand for several techniques
  bool describes = false;  // no device is needed for a description of the data

  void add_to(CLI::App& command);  // all options except --out
};

struct OneFrame {
  measure::SuiteWithTruth& suite;
  measure::Plan plan;  // a plan with that configuration, or with those that `auto` stands for
  std::string device;  // device id
};

// The suite and the one configuration that the arguments name. Throws core::InputError if they
// name several, or if its data are missing.
struct ChosenData {
  measure::SuiteWithTruth& suite;
  measure::Plan plan;
};
[[nodiscard]] ChosenData choose_data(const Registry& registry, const FrameArguments& arguments);

// Throws core::InputError unless the arguments name one configuration, its data and one device, and
// IoError if the folder cannot be written.
[[nodiscard]] OneFrame choose_frame(const Registry& registry, const FrameArguments& arguments);

}  // namespace triptych::app
