#pragma once
// The history of the devices in a series of stores, for example one store per day or per commit. It
// consists of the changes from store to store (except timing changes), and of the trends of cost
// and time since the first store.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "comparison/store_diff.hpp"
#include "comparison/time_change.hpp"

namespace triptych::comparison {

// The results of a device in one store.
struct HistoryPoint {
  std::string store;       // the file name
  std::string started_at;  // when the first run in the store started
  std::string driver_version;
  std::string triptych;            // version of Triptych that measured the results
  std::set<std::string> injected;  // faults injected with `run --inject`
  // Chained indices of cost and time. They are 1 for the first point. For a later point, each
  // configuration contributes a factor: its value, divided by its value in the most recent earlier
  // store that contains it, times the index of that earlier store. The index of the point is the
  // geometric mean of these factors. It is nullopt if no earlier store contains any of the
  // configurations.
  std::optional<double> cost;  // instructions of generated code and driver
  std::optional<double> time;  // median frame time on the wall clock, available in all stores
  // The change of the wall-clock times of the configurations that an earlier store contains.
  std::optional<TimeChange> time_change;
  // The number of configurations whose results are based on another clock (record::Record::clock)
  // than in the previous store that contains their times. The keys are the previous clock and the
  // clock in this store. The history always uses the wall clock, so these times are comparable.
  std::map<std::pair<std::string, std::string>, std::size_t> changed_clocks;
  // The changes of each configuration relative to the most recent earlier store that contains it.
  std::vector<DifferenceGroup> changes;
  bool worse = false;  // whether `changes` contains a regression
};

struct DeviceHistory {
  std::string device;
  std::vector<HistoryPoint> points;

  // Returns the first point that is worse than the previous point, or nullptr if there is none.
  [[nodiscard]] const HistoryPoint* first_worse() const;
};

// The results of a configuration on a device. Cost and time are set only if the configuration was
// measured.
struct Measurement {
  std::optional<double> cost;
  std::optional<double> time;
  double time_spread = 0;     // judge::log_spread of the frame times
  std::string clock = {};     // record::Record::clock, if the configuration was timed
  std::string injected = {};  // see record::Record::injected
};
// The keys are "PLAN CONFIGURATION".
using MeasurementsByConfiguration = std::map<std::string, Measurement>;

// Sorts the stores by the start time of their first run. Stores with equal start times keep the
// given order.
[[nodiscard]] std::vector<record::Store*> sorted_by_time(const std::vector<record::Store*>& stores);

// Builds the histories of all devices that match one of the globs `devices`. If there are no globs,
// builds the histories of all devices. Throws the same exceptions as record::Store.
class HistoryBuilder {
 public:
  explicit HistoryBuilder(std::vector<std::string> devices) : devices_(std::move(devices)) {}

  // Adds the next store, which must outlive this object. `truths` must provide the reference images
  // for the records of this store and of all previous stores.
  void add(const record::Store& store, measure::Truths& truths);
  [[nodiscard]] const std::vector<DeviceHistory>& devices() const { return history_; }

 private:
  using Points = std::map<std::string, HistoryPoint>;  // by device
  // The most recent cost or time of a configuration.
  struct Link {
    double measured;  // the cost or time as measured
    double index;     // the chained index (HistoryPoint::cost or ::time) of the store it comes from
  };
  using Chain = std::map<std::string, Link>;
  struct DeviceState {  // what is known about a device so far
    Chain cost;
    Chain time;
    std::map<std::string, Measurement> timed;  // the most recent timed measurements
    const record::Store* last = nullptr;       // the latest store with the device
    // The latest store with each configuration.
    std::map<std::string, const record::Store*> latest_with;

    // Returns the store with which a configuration is compared: the latest store that contains the
    // configuration or, if there is none, the latest store that contains the device.
    [[nodiscard]] const record::Store* previous_store(const std::string& configuration) const;
  };
  [[nodiscard]] Points points_of(const record::Store& store) const;
  DeviceHistory& history_of(const std::string& device);

  static std::optional<double> extend_chain(Chain& chain, const MeasurementsByConfiguration& here,
                                            std::optional<double> Measurement::*value);
  // Sets the members of `point` that describe times, except for the index.
  static void add_times(DeviceState& known, const MeasurementsByConfiguration& here,
                        HistoryPoint& point);
  void add_changes(const record::Store& store,
                   const std::map<std::string, MeasurementsByConfiguration>& measured,
                   measure::Truths& truths, Points& points) const;

  std::vector<std::string> devices_;
  std::vector<DeviceHistory> history_;
  std::map<std::string, DeviceState> known_;  // by device
};

// Returns, for each store, the shortest suffix of its path that distinguishes it from the other
// stores. The keys of the map are the paths.
[[nodiscard]] std::map<std::string, std::string> names_of(
    const std::vector<DeviceHistory>& history);

}  // namespace triptych::comparison
