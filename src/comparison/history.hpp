#pragma once
// The changes from store to store over many days or commits, except in times, and the development
// of cost and time since the first store.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "comparison/store_diff.hpp"

namespace triptych::comparison {

// A device in one store.
struct HistoryPoint {
  std::string store;       // the file name
  std::string started_at;  // start of its first run
  std::string driver_version;
  std::string triptych;            // version of the program
  std::set<std::string> injected;  // faults that `run --inject` put into it
  // Cost and time relative to the first point. From point to point, they change by the geometric
  // mean of the ratios of all configurations, each relative to the last store that has it. Empty if
  // no earlier store has any of the configurations.
  std::optional<double> cost;  // instructions of generated code and driver
  std::optional<double> time;  // median of the frames by the wall clock, which all stores have
  // The changes of each configuration relative to the last store that has it.
  std::vector<DifferenceGroup> changes;
  bool worse = false;  // whether a regression is among them
};

struct DeviceHistory {
  std::string device;
  std::vector<HistoryPoint> points;

  // The first point that is worse than the previous one; nullptr if there is none.
  [[nodiscard]] const HistoryPoint* first_worse() const;
};

// A configuration on a device, with cost and time if it was measured.
struct Measured {
  std::optional<double> cost;
  std::optional<double> time;
  std::string injected;  // see record::Record::injected
};
using MeasuredByConfiguration = std::map<std::string, Measured>;  // by plan and configuration

// Sorts the stores by the start of their first run. Stores with equal starts keep the given order.
[[nodiscard]] std::vector<record::Store*> in_order(const std::vector<record::Store*>& stores);

// `devices` are globs; if empty, all devices. Throws what record::Store throws.
class HistoryBuilder {
 public:
  explicit HistoryBuilder(std::vector<std::string> devices) : devices_(std::move(devices)) {}

  // Adds the next store, which must outlive this object. `truths` must provide the reference images
  // for its records and for those of the previous stores.
  void add(const record::Store& store, measure::Truths& truths);
  [[nodiscard]] const std::vector<DeviceHistory>& devices() const { return history_; }

 private:
  using Points = std::map<std::string, HistoryPoint>;  // by device
  // The last values of a configuration, and their ratios to the first point.
  struct Link {
    double amount;
    double value;
  };
  using Chain = std::map<std::string, Link>;
  struct Known {  // about a device
    Chain cost;
    Chain time;
    const record::Store* last = nullptr;                 // the last store with the device
    std::map<std::string, const record::Store*> holder;  // the last store with each configuration

    // The store with which a configuration is compared: the last one with the device if none has
    // the configuration.
    [[nodiscard]] const record::Store* before(const std::string& configuration) const;
  };
  [[nodiscard]] Points points_of(const record::Store& store) const;
  DeviceHistory& of(const std::string& device);

  static std::optional<double> extend(Chain& chain, const MeasuredByConfiguration& here,
                                      std::optional<double> Measured::*value);
  void add_changes(const record::Store& store,
                   const std::map<std::string, MeasuredByConfiguration>& measured,
                   measure::Truths& truths, Points& points) const;

  std::vector<std::string> devices_;
  std::vector<DeviceHistory> history_;
  std::map<std::string, Known> known_;  // by device
};

// The shortest end of each store's path that distinguishes it from the others, by path.
[[nodiscard]] std::map<std::string, std::string> names_of(
    const std::vector<DeviceHistory>& history);

}  // namespace triptych::comparison
