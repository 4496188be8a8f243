#pragma once
// Made-up costs of one plan on several devices: both the current and the accepted costs.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "judge/gate/cost_by_device.hpp"

namespace triptych::judge {

// The plan has 96 configurations: techniques × data × steps × cameras.
class SyntheticRun {
 public:
  explicit SyntheticRun(std::uint64_t seed) : random_(seed) {}

  bool with_times = false;

  // A function that returns the factor by which the cost of a configuration changed since it was
  // accepted.
  using Change = std::function<double(const record::Record&)>;

  // Returns a number that is uniformly distributed between −1 and 1.
  double jitter() { return random_.uniform(-1, 1); }
  double normal() {
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += random_.uniform(0, 1);
    return sum - 6;
  }

  // Adds the current counts of a device: its made-up costs, with the given changes and with driver
  // jitter within the bounds. If `accepted` is true, also stores the unchanged costs as accepted
  // costs, with different jitter.
  void add_device(const std::string& id, bool accepted, double scatter = 0.02,
                  const Change& device_code = {}, const Change& driver = {}) {
    record::Device device;
    device.id = id;
    device.driver_version = "1";
    DriverCost stored{id, "1", "emulator", {}};
    for (int i = 0; i < 96; ++i) {
      auto record = std::make_unique<record::Record>();
      record->suite = "volume";
      record->plan = "volume/correlation";
      record->device = id;
      record->technique = fmt::format("t{}", i % 4);
      record->factors = {{"data", fmt::format("d{}", i / 4 % 4)},
                         {"step", fmt::format("{}", i / 16 % 3)},
                         {"camera", fmt::format("c{}", i / 48)}};
      record->configuration = fmt::format("camera=c{},data=d{},step={},technique=t{}", i / 48,
                                          i / 4 % 4, i / 16 % 3, i % 4);
      record->outcome = record::Outcome::measured;
      record->counted_by = "emulator";
      const double frame = std::exp(15 + 0.02 * i + scatter * normal());
      // The stored and the current count each differ from the made-up cost by at most half of the
      // bound, so that they differ from each other by at most the bound.
      const double bound =
          repeatability(id, record->technique, {0.7 * frame, 0.3 * frame}).driver / 2.01;
      stored.configurations[record->configuration].frame =
          counts(0.7 * frame, 0.3 * frame + bound * frame * jitter());
      record->cost =
          counts(0.7 * frame * (device_code ? device_code(*record) : 1),
                 0.3 * frame * (driver ? driver(*record) : 1) + bound * frame * jitter());
      if (with_times) record->wall_ns = {frame, 1.01 * frame, 1.02 * frame};
      input_.records.push_back(record.get());
      records_.push_back(std::move(record));
    }
    input_.devices.emplace(id, device);
    if (accepted) input_.stored.emplace(device.statistics_key(), stored);
  }

  CorrelationInput& input() { return input_; }
  [[nodiscard]] CorrelationFindings judge() const { return correlate(input_); }

 private:
  static record::Counts counts(double device_code, double driver) {
    return {{"device_code", static_cast<std::uint64_t>(device_code)},
            {"driver", static_cast<std::uint64_t>(driver)},
            {"libc", 12345},
            {"program", 54321}};
  }

  core::Random random_;
  std::vector<std::unique_ptr<record::Record>> records_;
  CorrelationInput input_;
};

inline SyntheticRun::Change on_configuration(const std::string& configuration, double factor) {
  return [=](const record::Record& record) {
    return record.configuration == configuration ? factor : 1;
  };
}

inline SyntheticRun::Change on_level(const std::string& factor, const std::string& level,
                                     double by) {
  return [=](const record::Record& record) { return record.factors.at(factor) == level ? by : 1; };
}

inline std::string text(const CorrelationFindings& result) {
  std::string all;
  for (const Finding& finding : result.findings) {
    all += fmt::format("{} {} {} {}: {}\n", name_of(finding.verdict), finding.device,
                       finding.configuration, finding.subject, name_of(finding.cause));
  }
  return all;
}

}  // namespace triptych::judge
