#pragma once
// The differences between two stores, except timing differences. The stores may come, for example,
// from before and after a driver upgrade. Neither driver needs to be installed.

#include <compare>
#include <string>
#include <vector>

#include "comparison/run_diff.hpp"
#include "core/error.hpp"

namespace triptych::comparison {

// The changes on one device, over all plans that have a run in both stores.
struct DeviceChange {
  record::Device a;
  record::Device b;
  std::vector<Difference> device;                 // differences in device properties
  std::vector<ConfigurationDiff> configurations;  // their keys are "PLAN CONFIGURATION"

  [[nodiscard]] bool has(DifferenceKind kind) const;
};

// Groups the differences, so that a difference that occurs in several configurations is reported
// only once.
[[nodiscard]] std::vector<DifferenceGroup> groups_of(const DeviceChange& change);
// Returns whether at least one configuration was measured in both stores.
[[nodiscard]] bool was_measured(const DeviceChange& change);

// A plan, or a device in a plan, that exists in only one of the two stores.
struct OneSidedEntry {
  std::string plan;
  std::string device;  // empty if the whole plan is missing
  measure::Side side = measure::Side::a;
  auto operator<=>(const OneSidedEntry&) const = default;
};

struct StoreDiff {
  std::vector<DeviceChange> devices;
  std::vector<OneSidedEntry> one_sided;

  // Returns `regression` if there is a regression. Otherwise, returns `cannot_judge` if the
  // stores have no measured configuration in common, if a plan or device exists in only one of the
  // stores, or if a difference could not be judged.
  [[nodiscard]] core::ExitCode exit_code() const;
};

// Compares the latest run of each plan in both stores, for all devices that match one of the globs
// `devices`. If there are no globs, compares all devices. `truths` must provide the reference
// images for the records of both stores. Throws the same exceptions as record::Store.
[[nodiscard]] StoreDiff diff_stores(const record::Store& a, const record::Store& b,
                                    const std::vector<std::string>& devices,
                                    measure::Truths& truths);

}  // namespace triptych::comparison
