#pragma once
// What commands share that draw one configuration on one device.

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

  bool chooses = false;  // "auto" may stand for several techniques

  void add_to(CLI::App& command);  // all but --out
};

struct OneFrame {
  measure::SuiteWithTruth& suite;
  measure::Plan plan;  // of that configuration, or of those that "auto" stands for
  std::string device;  // its id
};

// Throws core::InputError where it is not one configuration with its data on one device, IoError
// where its folder cannot be written.
[[nodiscard]] OneFrame choose_frame(const Registry& registry, const FrameArguments& arguments);

}  // namespace triptych::app
