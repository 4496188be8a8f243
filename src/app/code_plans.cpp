#include "app/code_plans.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "app/terminal.hpp"
#include "core/glob.hpp"
#include "judge/baselines/baselines.hpp"

namespace triptych::app {

const std::vector<std::string> code_plans{"volume/code", "particles/code"};

JudgedCompilers judged_compilers(const measure::Plan& plan,
                                 const std::vector<record::Device>& found,
                                 const std::vector<std::string>& globs,
                                 const std::string& baselines) {
  const judge::Baselines stored(baselines, plan.name);
  const auto is_requested = [&](const std::string& id) {
    return globs.empty() || core::any_glob_matches(globs, id);
  };
  JudgedCompilers compilers;
  std::set<std::string> devices;
  std::set<std::string> known;
  for (const record::Device& device : found) {
    if (!device.cpu_features.empty() || !is_requested(device.id)) continue;
    known.insert(device.id);
    if (stored.code(device) != nullptr) {
      devices.insert(device.id);
    } else {
      compilers.not_stored.push_back(fmt::format("{} ({})", device.id, device.driver_version));
    }
  }
  if (!devices.empty()) {
    for (const auto& [driver, code] : stored.code_of_all_drivers()) {
      if (!known.contains(code.device) && is_requested(code.device)) devices.insert(code.device);
    }
  }
  compilers.devices.assign(devices.begin(), devices.end());
  return compilers;
}

void print_not_judged(const JudgedCompilers& compilers, const std::string& plan) {
  if (compilers.not_stored.empty()) {
    if (!compilers.devices.empty()) return;
    print_err(
        "triptych: {} is not judged, because no GPU compiler is installed; for details, run "
        "`triptych devices --compilers`\n",
        plan);
    return;
  }
  print_err(
      "triptych: {} is not judged on {}, because the baselines contain no compiled code for {}; to "
      "compare with other driver versions, run `triptych gate {}`\n",
      plan, fmt::join(compilers.not_stored, ", "),
      compilers.not_stored.size() == 1 ? "this driver version" : "these driver versions", plan);
}

}  // namespace triptych::app
