#pragma once
// One of the plans that are measured together, on all its devices.

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "measure/device_run.hpp"
#include "measure/runner.hpp"
#include "measure/stopwatch.hpp"
#include "record/record.hpp"

namespace triptych::measure {

class RoundReport;

// Every record is in the store as soon as it is made. first_round() and further_round() throw what
// run_plans() throws.
class PlanRun {
 public:
  using Tell = std::function<void(const Progress&)>;

  // All must live as long.
  PlanRun(const RunContext& context, const std::vector<std::string>& devices, const Tell& tell);

  // Everything once, by the whole protocol; what a resumed run holds is left alone.
  void first_round();
  // The timed frames again, of what is not settled, as long as the budget lasts; `run` is the time
  // since the first round of the first plan began.
  void further_round(std::size_t round, const Stopwatch& run);
  [[nodiscard]] std::size_t most_rounds() const;
  // Lets go of the devices.
  [[nodiscard]] RunResult conclude();

 private:
  DeviceRun& on(const std::string& device);
  void leave(const std::string& device);
  void stop_if_asked();
  [[nodiscard]] std::vector<const Configuration*> pending(const std::string& device,
                                                          RoundReport& report) const;
  void measure(const std::string& device, const Configuration& configuration, RoundReport& report);
  [[nodiscard]] Done attempt(const std::string& device, const Configuration& configuration,
                             const std::string& key, RoundReport& report);
  void once_more(record::Record& record, RoundReport& report);
  void share_frames(record::Record& record);
  void share_rounds(const record::Record& measured);
  [[nodiscard]] bool is_ours(const record::Record& record) const;
  [[nodiscard]] bool is_on_our_devices(const record::Record& record) const;
  void count_what_is_there();
  void remember_records();

  const RunContext& context_;
  const std::vector<std::string>& devices_;
  const Tell& tell_;
  RunResult result_;
  double work_ns_ = 0;
  std::map<std::string, std::unique_ptr<DeviceRun>> open_;
  std::vector<record::Record> records_;  // of the plan, by frames of their own
  std::vector<record::Record> twins_;    // by those of another
  std::map<std::string, const Configuration*> by_key_;
  std::map<std::pair<std::string, std::string>, record::Record> measured_;  // device, configuration
};

}  // namespace triptych::measure
