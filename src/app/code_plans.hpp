#pragma once
// The plans with the check `code` that `gate` judges by default. They are judged only on devices
// for whose driver version the baselines contain code. Therefore `gate` still passes on a machine
// without a GPU compiler, or with a different version of the compiler.

#include <string>
#include <vector>

#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::app {

extern const std::vector<std::string> code_plans;

// The devices on which a plan with the check `code` is judged by default.
struct JudgedCompilers {
  std::vector<std::string> devices;     // ids, sorted
  std::vector<std::string> not_stored;  // "ID (DRIVER VERSION)" of each device without stored code
};

// Selects the devices in `found` that have stored code. `found` lists the devices of this machine
// or of a run. If any device is selected, the result also contains the devices that have stored
// code but were not found, because the gate must report them as missing if their driver is present.
// Only devices that match `globs` are considered; if `globs` is empty, all devices are considered.
[[nodiscard]] JudgedCompilers judged_compilers(const measure::Plan& plan,
                                               const std::vector<record::Device>& found,
                                               const std::vector<std::string>& globs,
                                               const std::string& baselines);

// If some devices are not judged, prints a line with the reason.
void print_not_judged(const JudgedCompilers& compilers, const std::string& plan);

}  // namespace triptych::app
