#pragma once
// Two stores, of a driver before and after an upgrade: what differs besides time, without either
// driver.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "comparison/run_diff.hpp"
#include "core/error.hpp"

namespace triptych::comparison {

// A device over all plans that both stores hold a run of.
struct DeviceChange {
  record::Device a;
  record::Device b;
  std::vector<Difference> device;                 // of the two as such
  std::vector<ConfigurationDiff> configurations;  // "PLAN CONFIGURATION" each

  [[nodiscard]] bool has(DifferenceKind kind) const;
};

// What is alike in several of its configurations, once.
[[nodiscard]] DifferenceGroups groups_of(const DeviceChange& change);

struct StoreDiff {
  std::vector<DeviceChange> devices;
  std::vector<std::string> only_one;  // plans and devices of which one store has nothing

  // Of no device that both have, of what only one has, and where neither measured anything, nothing
  // can be told.
  [[nodiscard]] core::ExitCode exit_code() const;
};

// The latest run of each plan in either, of the devices that match one of the globs, of all without
// any. `truths`: of records of both. Throws as record::Store does.
[[nodiscard]] StoreDiff diff_stores(const record::Store& a, const record::Store& b,
                                    const std::vector<std::string>& devices,
                                    measure::Truths& truths);

// Each device with both versions, then its differences by kind, worst first, then the verdict.
[[nodiscard]] std::string to_text(const StoreDiff& diff);

// {"exit_code", "only_one", "devices": [{"a", "b" (devices), "differences" (of the device),
// "configurations": [{"configuration", "differences": [{"kind", "about", "text", "ratio"}]}]}]}
[[nodiscard]] nlohmann::json to_json(const StoreDiff& diff);

}  // namespace triptych::comparison
