#pragma once
// Arguments and functions shared by the commands that draw one configuration on one device.

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

  bool allow_auto = false;  // whether the level "auto" (several techniques) is allowed

  void add_to(CLI::App& command);  // adds all options except --out
};

struct OneFrame {
  measure::SuiteWithTruth& suite;
  measure::Plan plan;  // one configuration, or one per technique if the technique is `auto`
  std::string device;  // id
};

// The suite and the configuration named by the arguments.
struct ChosenData {
  measure::SuiteWithTruth& suite;
  measure::Plan plan;
};
[[nodiscard]] ChosenData choose_data(const Registry& registry, const FrameArguments& arguments);

// Throws core::InputError unless the arguments name exactly one configuration and one device and
// the data exist. Throws IoError if the output folder cannot be written.
[[nodiscard]] OneFrame choose_frame(const Registry& registry, const FrameArguments& arguments);

// Prints the driver and its version in one line, so that users notice if another driver was used
// than they expected.
void print_device(const record::Device& device);

}  // namespace triptych::app
