#pragma once
// The data about a run that every check gets, and the function of each check.

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::judge {

struct RunView {
  const record::Store& store;
  const Baselines& baselines;
  const GateRequest& request;
  record::Run run;
  std::set<Check> checks;
  std::vector<record::Record> records;               // of the requested devices
  std::map<std::string, record::Device> devices;     // by id
  std::vector<const record::Record*> measured;       // pointers into `records`
  std::vector<const record::Record*> of_other_data;  // measured, but the data are missing
                                                     // here, or differ from the accepted ones

  [[nodiscard]] const record::Device& device(const record::Record& record) const {
    return devices.at(record.device);
  }
  // Whether this version of the device's driver was accepted.
  [[nodiscard]] bool knows_driver(const record::Device& device) const;
  // The test id of findings that belong to no device.
  [[nodiscard]] std::string plan_test(Check check) const;
  // The plan as commands accept it.
  [[nodiscard]] std::string argument() const;
  // The date on which waivers may have expired. A clock that was set back after the run does not
  // bring one back.
  [[nodiscard]] std::string today() const;
  // Advice with the command that creates or renews the baselines.
  [[nodiscard]] Advised accept(Advice advice = Advice::accept) const;
};

[[nodiscard]] Finding finding_about(const record::Record& record, Check check, Verdict verdict,
                                    Observation what, Advised advice = {});
// A finding about a device as a whole, without a configuration.
[[nodiscard]] Finding finding_about(const RunView& view, const record::Device& device, Check check,
                                    Verdict verdict, Observation what, Advised advice = {});
[[nodiscard]] Finding finding_about(const RunView& view, Check check, Verdict verdict,
                                    Observation what, Advised advice = {});
// The worst first, then by device and configuration.
void sort_findings(std::vector<Finding>& findings);

// (device, configuration) → the error in its image. The time of such a record has no meaning.
using WrongImages = std::map<std::pair<std::string, std::string>, Observation>;

struct ImageFindings {
  std::vector<Finding> findings;
  WrongImages wrong;
};

[[nodiscard]] ImageFindings check_images(const RunView& view);
[[nodiscard]] std::vector<Finding> check_counters(const RunView& view);
[[nodiscard]] std::vector<Finding> check_statistics(const RunView& view);
[[nodiscard]] std::vector<Finding> check_cost(const RunView& view);
[[nodiscard]] std::vector<Finding> check_code(const RunView& view);
[[nodiscard]] std::vector<Finding> check_memory(const RunView& view);
[[nodiscard]] std::vector<Finding> check_timings(const RunView& view, const WrongImages& wrong);

struct CorrelationFindings {
  std::vector<Finding> findings;
  std::vector<CorrelationPair> pairs;
};
[[nodiscard]] CorrelationFindings check_correlations(const RunView& view, const WrongImages& wrong);

struct AccuracyFindings {
  std::vector<Finding> findings;
  std::vector<accuracy::AccuracyScene> scenes;
};
// Without baselines, the result contains scenes but no findings.
[[nodiscard]] AccuracyFindings check_accuracies(const RunView& view);

// One finding for each record that has a score, including records that failed.
[[nodiscard]] std::vector<Finding> check_stress(const RunView& view);

// Checks whether the run has all planned configurations, on all devices that its machine should
// have, and whether the plan requests all checks of its baselines.
void report_as_begun(const RunView& view, std::vector<Finding>& findings);

// Whether an unexpired entry of waivers.json covers findings of this check about the record.
[[nodiscard]] bool is_waived(const RunView& view, const record::Record& record, Check check);

// Turns regressions that waivers.json excuses into waived ones, and reports waivers that have
// expired.
void apply_waivers(const RunView& view, std::vector<Finding>& findings);

// Compares findings with GateRequest::known: a known failure becomes waived, a pass that is listed
// as a failure becomes improved, and a skip that is not listed cannot be judged.
void apply_known(const RunView& view, std::vector<Finding>& findings);

}  // namespace triptych::judge
