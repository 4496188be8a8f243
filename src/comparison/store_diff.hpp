#pragma once
// The differences between two stores, for example before and after a driver upgrade, except in
// time. Neither driver needs to be installed.

#include <compare>
#include <string>
#include <vector>

#include "comparison/run_diff.hpp"
#include "core/error.hpp"

namespace triptych::comparison {

// The changes of a device over all plans that have a run in both stores.
struct DeviceChange {
  record::Device a;
  record::Device b;
  std::vector<Difference> device;                 // between the two devices themselves
  std::vector<ConfigurationDiff> configurations;  // each "PLAN CONFIGURATION"

  [[nodiscard]] bool has(DifferenceKind kind) const;
};

// The differences, grouped so that each is reported once even if several configurations share it.
[[nodiscard]] std::vector<DifferenceGroup> groups_of(const DeviceChange& change);
// Whether any configuration was measured on both sides.
[[nodiscard]] bool was_measured(const DeviceChange& change);

// A plan, or a device of a plan, that only one store has.
struct OnlyOne {
  std::string plan;
  std::string device;  // empty: the whole plan
  measure::Side side = measure::Side::a;
  auto operator<=>(const OnlyOne&) const = default;
};

struct StoreDiff {
  std::vector<DeviceChange> devices;
  std::vector<OnlyOne> only_one;

  // cannot_judge if no device is in both stores, if one store lacks something, or if neither side
  // measured anything.
  [[nodiscard]] core::ExitCode exit_code() const;
};

// Compares the latest run of each plan in both stores, for the devices that match one of the globs,
// or for all without globs. `truths` must provide the reference images for the records of both
// stores. Throws what record::Store throws.
[[nodiscard]] StoreDiff diff_stores(const record::Store& a, const record::Store& b,
                                    const std::vector<std::string>& devices,
                                    measure::Truths& truths);

}  // namespace triptych::comparison
