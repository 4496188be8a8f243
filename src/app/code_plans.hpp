#pragma once
// The default plans of the gate that run the check `code`. By default these plans are judged only
// on devices whose driver version has stored code. A machine without a GPU compiler, or with
// another version of the compiler, therefore still passes.

#include <string>
#include <vector>

#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::app {

extern const std::vector<std::string> code_plans;

// The devices on which a plan of the check `code` is judged by default.
struct JudgedCompilers {
  std::vector<std::string> devices;     // ids, sorted
  std::vector<std::string> not_stored;  // devices without stored code, as "ID (DRIVER VERSION)"
};

// Selects devices from `found`, which lists the devices of this machine or of a run. The result
// also contains devices that have stored code but were not found, because the gate reports such a
// device as missing if another device of the same driver is present. `globs` limits the devices; if
// it is empty, all devices are considered.
[[nodiscard]] JudgedCompilers judged_compilers(const measure::Plan& plan,
                                               const std::vector<record::Device>& found,
                                               const std::vector<std::string>& globs,
                                               const std::string& baselines);

// Prints why devices are not judged, one line per reason.
void print_not_judged(const JudgedCompilers& compilers, const std::string& plan);

}  // namespace triptych::app
