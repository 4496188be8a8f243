#pragma once
// The plans of the check `code` among the plans that the gate judges by default. By default they
// are judged only on devices whose driver version has stored code, so that a machine without a GPU
// compiler, or with another version of it, still passes.

#include <string>
#include <vector>

#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::app {

extern const std::vector<std::string> code_plans;

// The devices on which a plan of the check `code` is judged by default.
struct JudgedCompilers {
  std::vector<std::string> devices;     // ids, sorted
  std::vector<std::string> not_stored;  // "ID (DRIVER VERSION)" of the devices without stored code
};

// Selects devices from `found`, which are the devices of the machine or of a run. `devices` also
// contains devices that have stored code but were not found, because the gate reports them as
// missing if another device of the same driver is present. `globs`: the devices that the user
// named; empty: all.
[[nodiscard]] JudgedCompilers judged_compilers(const measure::Plan& plan,
                                               const std::vector<record::Device>& found,
                                               const std::vector<std::string>& globs,
                                               const std::string& baselines);

// Prints one line for each reason why devices are not judged.
void print_not_judged(const JudgedCompilers& compilers, const std::string& plan);

}  // namespace triptych::app
