#pragma once
// Probes the features of devices and prints them, for `features` and `validate`.

#include <map>
#include <string>
#include <vector>

#include "core/exit_code.hpp"
#include "core/json.hpp"
#include "measure/worker/feature_run.hpp"

namespace triptych::app {

// The key is the device.
using FeatureTable = std::map<std::string, std::vector<measure::FeatureRow>>;

// `only`: the name of a probe; empty: all. Devices that cannot be probed have no rows.
[[nodiscard]] FeatureTable probe_devices(const std::vector<std::string>& devices,
                                         const std::string& only, int limit_s);

// One line for each probe: its size, and the error or the reason for a skip.
[[nodiscard]] std::string feature_text(const FeatureTable& table);
[[nodiscard]] core::Json feature_json(const FeatureTable& table);

// Regression if a probe is wrong; cannot_judge if none is right.
[[nodiscard]] core::ExitCode verdict_of(const FeatureTable& table);

}  // namespace triptych::app
