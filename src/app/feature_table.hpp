#pragma once
// Probes API features of devices and prints the results, for `features` and `validate`.

#include <map>
#include <string>
#include <vector>

#include "core/exit_code.hpp"
#include "core/json.hpp"
#include "measure/worker/feature_run.hpp"

namespace triptych::app {

// The results of all feature probes, by device id.
using FeatureTable = std::map<std::string, std::vector<measure::FeatureRow>>;

// Probes the devices. `only` is the name of one probe; if it is empty, all probes run. Devices that
// cannot be probed have no rows.
[[nodiscard]] FeatureTable probe_devices(const std::vector<std::string>& devices,
                                         const std::string& only, int limit_s);

// Returns one line per probe, with the largest size that the probe used, such as "100000 draws",
// and its error or the reason for its skip.
[[nodiscard]] std::string feature_text(const FeatureTable& table);
// Returns a line with the number of probes with each verdict, and a line for each of the first few
// probes with wrong results.
[[nodiscard]] std::string feature_summary(const FeatureTable& table);
[[nodiscard]] core::Json feature_json(const FeatureTable& table);

// Returns regression if any probe returned wrong results, and cannot_judge if no probe returned
// correct results.
[[nodiscard]] core::ExitCode verdict_of(const FeatureTable& table);

}  // namespace triptych::app
