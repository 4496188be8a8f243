#pragma once
// Stores of many days or commits, in their order: what each changed besides time, and how cost and
// time have moved since the first.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "comparison/store_diff.hpp"

namespace triptych::comparison {

// A device in one store.
struct HistoryPoint {
  std::string store;       // its file
  std::string started_at;  // its first run
  std::string driver_version;
  std::string triptych;            // the program's version
  std::set<std::string> injected;  // faults that `run --inject` put into it
  // Of the first point, by the geometric mean over the configurations that were there before, each
  // since the last store that told it, multiplied from point to point; empty where none was.
  std::optional<double> cost;  // instructions of generated code and driver
  std::optional<double> time;  // median of the frames by the wall clock, which all have
  // Of each configuration against the last store that has it, as `diff` tells; empty: nothing.
  std::string changes;
  bool worse = false;  // a regression is among them
};

struct DeviceHistory {
  std::string device;
  std::vector<HistoryPoint> points;

  // The first point that is worse than the one before; nullptr: none is.
  [[nodiscard]] const HistoryPoint* first_worse() const;
};

// Of a configuration on a device; cost and time where it was measured.
struct Measured {
  std::optional<double> cost;
  std::optional<double> time;
  std::string injected;  // as of the record
};
using MeasuredByConfiguration = std::map<std::string, Measured>;  // by plan and configuration

// Stores by the time at which their first run began; of equals as given.
[[nodiscard]] std::vector<record::Store*> in_order(const std::vector<record::Store*>& stores);

// `devices`: globs; all without any. Throws as record::Store does.
class HistoryBuilder {
 public:
  explicit HistoryBuilder(std::vector<std::string> devices) : devices_(std::move(devices)) {}

  // The next store, which must live as long; `truths`: of its records and of those before.
  void add(const record::Store& store, measure::Truths& truths);
  [[nodiscard]] const std::vector<DeviceHistory>& devices() const { return history_; }

 private:
  using Points = std::map<std::string, HistoryPoint>;  // by device
  // Of a configuration what it last took, and what of the first point that was.
  struct Link {
    double amount;
    double value;
  };
  using Chain = std::map<std::string, Link>;
  struct Known {  // of a device
    Chain cost;
    Chain time;
    const record::Store* last = nullptr;                 // that held the device
    std::map<std::string, const record::Store*> holder;  // the last of each configuration

    // The store that a configuration is held against: the last one where none has it.
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

// Each device with a line per store, then the first store that was worse.
[[nodiscard]] std::string to_text(const std::vector<DeviceHistory>& history);
// [{"device", "first_worse", "points": [{"store", "name", "started_at", "driver_version",
// "triptych", "injected", "cost", "time", "changes", "worse"}]}]; what is not known is absent.
[[nodiscard]] nlohmann::json to_json(const std::vector<DeviceHistory>& history);

}  // namespace triptych::comparison
