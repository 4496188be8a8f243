#pragma once
// Measures one plan, or a part of a plan, on one or more devices. If nothing is timed, several
// objects of this class may run at the same time.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "measure/run/device_run.hpp"
#include "measure/run/failure_predictor.hpp"
#include "measure/run/runner.hpp"
#include "measure/system/stopwatch.hpp"
#include "record/record.hpp"

namespace triptych::measure {

class Report;

// Writes every record to the store as soon as it is complete. measure_all() throws the same
// exceptions as run_plans().
class PlanRun {
 public:
  using OnProgress = std::function<void(const Progress&)>;

  // All arguments must outlive this object.
  PlanRun(const RunContext& context, const std::vector<std::string>& devices,
          const OnProgress& on_progress);

  // Measures all configurations by the complete protocol, except those for which a resumed run
  // already has a record.
  [[nodiscard]] RunResult measure_all();

 private:
  DeviceRun& device_run(const std::string& device);
  FailurePredictor& failures_of(const std::string& device);
  void close(const std::string& device);
  void throw_if_interrupted();
  [[nodiscard]] std::vector<const Configuration*> pending(const std::string& device,
                                                          Report& report) const;
  void measure(const std::string& device, const Configuration& configuration, Report& report);
  [[nodiscard]] ConfigurationResult attempt(const std::string& device,
                                            const Configuration& configuration,
                                            const std::string& key, Report& report);
  void reuse_results(record::Record& record);
  [[nodiscard]] bool belongs_to_plan(const record::Record& record) const;
  void count_stored_records();

  const RunContext& context_;
  const std::vector<std::string>& devices_;
  const OnProgress& on_progress_;
  RunResult result_;
  double work_ns_ = 0;
  std::map<std::string, std::unique_ptr<DeviceRun>> open_;
  std::map<std::string, const Configuration*> by_key_;  // the plan's configurations
  std::map<std::string, FailurePredictor> failures_;    // by device
  std::map<std::pair<std::string, std::string>, record::Record> measured_;  // device, configuration
};

}  // namespace triptych::measure
