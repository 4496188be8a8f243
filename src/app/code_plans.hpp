#pragma once
// The plans with the check `code` that `gate` judges by default. They compare the code that a
// device's compiler generates. A device is judged only if the baselines contain compiled code for
// its driver version. Therefore `gate` still passes on a machine without a GPU compiler, or with a
// different version of the compiler.

#include <string>
#include <vector>

#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::app {

extern const std::vector<std::string> code_plans;

// The devices on which a plan with the check `code` is judged by default.
struct JudgedCompilers {
  std::vector<std::string> devices;  // ids, sorted
  // "ID (DRIVER VERSION)" of each device for which the baselines contain no compiled code.
  std::vector<std::string> not_stored;
};

// Selects the devices in `found` for whose driver version the baselines contain compiled code.
// `found` lists the devices of this machine or of a run. If any device is selected, the result also
// contains the devices that are in the baselines but were not found, because the gate must report
// them as missing if their driver is present. Only devices that match `globs` are considered; if
// `globs` is empty, all devices are considered.
[[nodiscard]] JudgedCompilers judged_compilers(const measure::Plan& plan,
                                               const std::vector<record::Device>& found,
                                               const std::vector<std::string>& globs,
                                               const std::string& baselines);

// Prints why some devices are not judged. Prints nothing if all devices are judged.
void print_not_judged(const JudgedCompilers& compilers, const std::string& plan);

}  // namespace triptych::app
