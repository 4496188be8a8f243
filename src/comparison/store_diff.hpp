#pragma once
// The differences between two stores, for example before and after a driver upgrade, except in
// time. Neither driver needs to be installed.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "comparison/run_diff.hpp"
#include "core/error.hpp"

namespace triptych::comparison {

// A device, over all plans of which both stores have a run.
struct DeviceChange {
  record::Device a;
  record::Device b;
  std::vector<Difference> device;                 // between the two devices themselves
  std::vector<ConfigurationDiff> configurations;  // each "PLAN CONFIGURATION"

  [[nodiscard]] bool has(DifferenceKind kind) const;
};

// Differences that several of its configurations share, once each.
[[nodiscard]] DifferenceGroups groups_of(const DeviceChange& change);

struct StoreDiff {
  std::vector<DeviceChange> devices;
  std::vector<std::string> only_one;  // plans and devices that only one store has

  // cannot_judge if no device is in both stores, if one store lacks something, or if neither side
  // measured anything.
  [[nodiscard]] core::ExitCode exit_code() const;
};

// Compares the latest run of each plan in both stores, for the devices that match one of the globs,
// or for all without globs. `truths` are those of the records of both. Throws what record::Store
// throws.
[[nodiscard]] StoreDiff diff_stores(const record::Store& a, const record::Store& b,
                                    const std::vector<std::string>& devices,
                                    measure::Truths& truths);

// Each device with both versions, then its differences by kind with the worst first, then the
// verdict.
[[nodiscard]] std::string to_text(const StoreDiff& diff);

// {"exit_code", "only_one", "devices": [{"a", "b" (devices), "differences" (of the device),
// "configurations": [{"configuration", "differences": [{"kind", "about", "text", "ratio"}]}]}]}
[[nodiscard]] nlohmann::json to_json(const StoreDiff& diff);

}  // namespace triptych::comparison
