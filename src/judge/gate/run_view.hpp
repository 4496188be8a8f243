#pragma once
// The data about a run that is passed to every check, and the functions that run the checks.

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
  std::vector<record::Record> records;            // the records of the requested devices
  std::map<std::string, record::Device> devices;  // by id
  std::vector<const record::Record*> measured;    // pointers into `records`
  // Measured records whose data differ from the accepted data, or whose data have changed since the
  // measurement.
  std::vector<const record::Record*> with_other_data;

  [[nodiscard]] const record::Device& device(const record::Record& record) const {
    return devices.at(record.device);
  }
  // Returns whether this version of the device's driver was accepted.
  [[nodiscard]] bool knows_driver(const record::Device& device) const;
  // Returns the verdict of a check that must compare with values of the same driver version, if
  // none are stored. It is only an advisory in CTest tests of a single check, which are skipped if
  // they have no verdict.
  [[nodiscard]] Verdict not_stored_verdict() const {
    return request.decides_each_device ? Verdict::cannot_judge : Verdict::advisory;
  }
  // Returns the beginning of all test ids of the plan, such as "volume.quick.". Unlike
  // Record::test_prefix(), it lacks the suite if the plan comes from a file.
  [[nodiscard]] std::string plan_test_prefix() const;
  // Returns the test id of findings that belong to no device.
  [[nodiscard]] std::string plan_test_id(Check check) const;
  // Returns the plan as a command-line argument.
  [[nodiscard]] std::string argument() const;
  // Returns the date that decides whether a waiver has expired: GateRequest::today or the day of
  // the run, whichever is later, so that setting the clock back does not revive an expired waiver.
  [[nodiscard]] std::string today() const;
  // Returns advice with the `triptych accept` command that creates or updates the baselines.
  [[nodiscard]] AdviceWithCommand accept_advice(Advice advice = Advice::accept) const;
  // Returns advice with the command that measures what the run lacks.
  [[nodiscard]] AdviceWithCommand resume_advice() const;
};

[[nodiscard]] Finding finding_about(const record::Record& record, Check check, Verdict verdict,
                                    Observation observation, AdviceWithCommand advice = {});
// Creates a finding about a device as a whole, without a configuration.
[[nodiscard]] Finding finding_about(const RunView& view, const record::Device& device, Check check,
                                    Verdict verdict, Observation observation,
                                    AdviceWithCommand advice = {});
// Creates a finding about the whole plan.
[[nodiscard]] Finding finding_about(const RunView& view, Check check, Verdict verdict,
                                    Observation observation, AdviceWithCommand advice = {});
// Sorts by verdict (the worst first), then by device, then by the size of the change.
void sort_findings(std::vector<Finding>& findings);

// The errors in wrong images, by (device, configuration). The time of a record with a wrong image
// is meaningless.
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
// Without baselines, the result contains the errors of the scenes but compares none of them.
[[nodiscard]] AccuracyFindings check_accuracies(const RunView& view);

// Returns one finding for each record that has a score, including records that failed.
[[nodiscard]] std::vector<Finding> check_stress(const RunView& view);

// Describes the devices of the run (GateResult::tested).
[[nodiscard]] std::map<std::string, TestedDevice> tested_devices(const RunView& view);

// Reports missing and extra records. Every device must have a record, with any outcome, for every
// configuration of the plan and for every accepted configuration, but for no other configuration.
void report_configurations(const RunView& view, std::vector<Finding>& findings);

// Reports required devices that measured nothing, with the reason if the run recorded one.
void report_required_devices(const RunView& view, std::vector<Finding>& findings);

// Reports checks that the baselines contain but the plan no longer requests, devices that the run
// does not describe, device enumerations that failed, and accepted devices that are missing.
void report_incomplete_run(const RunView& view, std::vector<Finding>& findings);

// Reports that there are no baselines, with which the checks in `comparing` compare.
void report_no_baselines(const RunView& view, const std::set<Check>& comparing,
                         std::vector<Finding>& findings);

// Returns whether an unexpired entry of waivers.json covers findings of this check about the
// record.
[[nodiscard]] bool is_waived(const RunView& view, const record::Record& record, Check check);

// Changes regressions that waivers.json excuses to `waived`. Reports waivers that excuse nothing,
// although this run covers everything that they can excuse; expired waivers that excuse nothing;
// and waivers that match no test or name no plan.
void apply_waivers(const RunView& view, std::vector<Finding>& findings);

// Compares findings with GateRequest::expected_outcomes. A known failure becomes `waived`, a pass
// that is listed as a failure or as a skip becomes `improved`, and a skip that is not listed
// becomes `cannot_judge`.
void apply_expected_outcomes(const RunView& view, std::vector<Finding>& findings);

}  // namespace triptych::judge
