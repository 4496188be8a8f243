#pragma once
// The judge's findings, as data. report/words/ turns each cause into a sentence. No code compares
// `detail`, because it contains text that drivers, libraries and people wrote. docs/report.md
// describes the JSON form of a finding.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "judge/baselines/waivers.hpp"
#include "record/check.hpp"
#include "record/record.hpp"

namespace triptych::judge {

using record::Check;
using record::check;
using record::name_of;

enum class Verdict : std::uint8_t {
  pass,
  improved,      // a pass that is significantly better than the baseline
  advisory,      // does not affect the verdict: times, comparison with another driver version
  skipped,       // not checked, for example because the device does not support it; see the cause
  waived,        // a known regression, listed in waivers.json or in the file for `--expect`
  cannot_judge,  // a baseline or a measurement is missing, or the data changed; never a pass
  regression
};
[[nodiscard]] std::string_view name_of(Verdict verdict);

// The reason for a verdict. report/words/ has one sentence for each cause. The brackets after a
// cause list the members of Observation that it sets: keys of `numbers` in "quotes", keys of
// `facts` in <angle brackets>, and all others by their names.
enum class Cause : std::uint8_t {
  none,

  // Causes that several checks share.
  as_stored,           // the values are as stored ["values": how many; names: values not compared]
  values_changed,      // values differ from the stored values [changes]
  unknown_values,      // values have no stored counterpart [names]
  not_stored,          // nothing is stored for some configurations [names]
  no_stored_device,    // nothing is stored for this device or driver version [<device_key>]
  not_reported,        // the device or the technique does not report this kind of value
  no_longer_reported,  // values are missing that existed when the baseline was accepted [names]
  untimed,             // the values were not read, because the run was not timed

  // Causes that concern a run as a whole.
  ended,               // the configuration was not measured [outcome, reason]
  no_run,              // no run was started
  nothing_measured,    // the run has no measured record [<run> <plan> "records"]
  no_required_device,  // no measured device matches a required glob [<glob>, detail, reason]
  device_missing,      // <sibling> is present, but a device accepted on the same machine is not
  listing_failed,      // a process crashed or hung during device enumeration [<what>, reason]
  no_description,      // the run has records of a device that it does not describe [<run>]
  checks_lost,         // the baselines contain checks that the plan no longer requests [names]
  missing,             // "missing" of "wanted" configurations have no record [names, <kind>]
  extra,               // the run has configurations that are not in the plan [names]
  other_plan,          // the run measured another version of the plan [<run> <plan> <hash> <now>]
  other_data,          // the data differ from the accepted data [<hash> <accepted>]
  data_changed,        // the data have changed since they were measured [<hash> <now>]
  no_baselines,        // there are no baselines [<folder>, <checked>; names: checks without them]
  nothing_decided,     // no check reached a verdict for the device
  device_fault,        // see record/device_fault.hpp [<kind> <subject> <last_words>, detail]
  // A waiver excuses nothing [<test> <device> <configuration> <expiry>, detail; "expired": 1 if it
  // has expired].
  unused_waiver,
  waiver_of_no_test,  // a waiver matches no test [<test>]
  waiver_of_no_plan,  // a waiver names a plan that does not exist [<test> <plan>]

  // Causes that concern images.
  within_bound,
  pixels_over_bound,
  not_finite,
  other_surface,  // a wrong particle is visible, or the correct one at a wrong depth
  size_differs,
  empty_image,
  no_image,           // the record has no image
  unreadable_image,   // the stored image cannot be read [detail]
  no_reference,       // there is no reference image [detail]
  reference_changed,  // the reference image differs from the accepted one [because: its errors]
  reference_as_stored,
  devices_agree,     // the images of two devices agree [<device> <other> "rms" "allowed"]
  devices_disagree,  // the images of two devices differ [<device> <other> "rms" "allowed"]

  // Causes that concern statistics.
  other_driver_statistics,  // compared only with other drivers [<driver_version>, changes, names]

  // Causes that concern cost and memory.
  two_counters,  // two emulators counted the run's instructions [<counted_by> <other>]
  // The stored cost comes from another driver version or another emulator [<driver_version>
  // <other_version> <counted_by> <other> <configuration>: the one with the largest increase,
  // "configurations" "median_ratio" "worst_ratio"].
  other_counter,
  frame_allocations,  // the allocations per frame changed [<configuration>, changes: the largest]
  preparing,          // the cost of preparation changed [<configuration>, changes: the largest]
  injected_memory,    // not compared, because the injected slowdown itself allocates memory

  // Causes that concern compiled GPU code.
  other_executables,  // executables were added or removed [names]
  other_disassembly,  // the disassembly changed, but not the statistics [names: configurations]
  other_compiler,     // another compiler built the stored code [<driver_version> <other_version>]

  // Causes that concern times.
  time,         // the time of a configuration ["median_ns" "baseline_ns" "ratio" "half_width"]
  times,        // the times of all configurations on a device ["ratio": the median, "worst_ratio"]
  other_clock,  // the stored times were measured by another clock [names]
  no_time,
  same_frames,  // not timed, because a configuration with the same work was timed instead [reason]
  wrong_image,  // the time is meaningless, because the image is wrong [because: its errors]

  // Causes that concern correlations. The line is fitted to the costs of this device as a function
  // of the costs of the device <other>.
  residuals_as_stored,  // the cost ratios to other devices are unchanged [names: devices]
  residual_moved,       // the cost ratios to other devices changed [names: devices]
  off_the_line,         // the cost differs from the cost predicted by the line for <other>
  on_the_line,          // the cost agrees with the cost predicted by the line for <other>
  no_line,              // no line fits the costs of this device and <other> [<refusal>]
  no_partner,           // no other accepted device was counted by the same emulator [<counted_by>]

  // Causes that concern accuracy. A limit image is the image with exact ray integrals, to which the
  // images of a scene converge as the step size decreases.
  error,              // the error against the limit image ["rmse" "bound"]
  unknown_error,      // the error cannot be measured [detail]
  not_comparable,     // the sizes differ, or a value is not finite
  no_limit,           // no scene of the plan has a limit image
  no_limit_any_more,  // an error is stored, but the scene no longer has a limit image
  order,              // the order of convergence ["order" "half_width" "stored_order" …]
  no_order,           // an order can no longer be fitted ["stored_order" "stored_half_width"]

  // Causes that concern stress cases (scenes on which renderers often fail).
  score,  // the points of a case ["score" "accepted"; because: the reasons for lost points]
  farther_device,  // <other> draws a different image, closer to the reference ["rms" "allowed"]
  pixels_differ,   // the image should equal the image with <levels>, but differs from it
  no_other_image,  // the image with <levels> that an expectation needs is missing
  not_inside,      // the image with <levels>, of which this image should be a part, is too small
  other_colour,    // a pixel does not have the expected colour
  not_counted,     // a counter that an expectation needs is missing [<counter> <levels>]
  count_too_large  // a count exceeds "factor" times "unit" [<counter> <of> <levels> "count"]
};
[[nodiscard]] std::string_view name_of(Cause cause);

// The stored or computed result with which a measurement is compared.
enum class Against : std::uint8_t {
  nothing,
  reference,      // the reference image
  stored_image,   // the image that was accepted
  baseline,       // accepted values of the same driver version
  other_devices,  // accepted values of other devices or driver versions
  expectation,    // the expectation of a stress case
};
[[nodiscard]] std::string_view name_of(Against against);

// The next step that a finding recommends. `command` is AdviceWithCommand::command.
enum class Advice : std::uint8_t {
  none,
  accept,                // accept the values with `command`
  accept_or_compare,     // accept the values with `command`, or compare two versions with --base
  accept_own,            // accept a user's plan with `command`, in the user's own baselines folder
  run_again,             // run the plan again
  resume,                // finish the run with `command`
  restore_data,          // restore the data and run again, or accept with `command`
  restore_or_run_again,  // restore the data, or run again
  restore_baselines,     // restore the baselines from version control, or replace with `command`
  count,                 // count instructions, or leave out the check `cost`
  judge_more,            // judge more checks, or accept with `command`
  more_time,             // use a longer --limit
  times,                 // use --times if times should affect the verdict
  repair_driver,         // repair the driver, or declare the device as missing with `command`
  remove_entry,          // remove the entry from the file of expectations
  remove_waiver          // remove the waiver
};
[[nodiscard]] std::string_view name_of(Advice advice);

struct AdviceWithCommand {
  Advice advice = Advice::none;
  std::string command = {};
};

enum class Unit : std::uint8_t { count, instructions, bytes, misses, allocations };
[[nodiscard]] std::string_view name_of(Unit unit);

// A value that differs from the value with which it was compared.
struct Change {
  std::string name;
  Unit unit = Unit::count;
  std::optional<double> before = {};            // nullopt: there was no such value
  std::optional<double> now = {};               // nullopt: the value is missing now
  std::map<std::string, double> accepted = {};  // accepted values by device, if there are several
  double allowed = 0;                           // the largest allowed difference
};

struct Observation {
  Cause cause = Cause::none;
  Against against = Against::nothing;
  // Finite numbers by name. If a number has a unit, the name ends with it, as in "median_ns".
  std::map<std::string, double> numbers = {};
  std::vector<Change> changes = {};
  std::vector<std::string> names = {};            // names of configurations, values or devices
  std::map<std::string, std::string> facts = {};  // identifiers, such as hashes and versions
  std::string detail = {};                        // the message of a library or an exception
  record::Outcome outcome = record::Outcome::measured;
  record::Reason reason = {};
  std::vector<Observation> because = {};

  [[nodiscard]] double number(const std::string& name) const;  // 0 if there is no such number
  [[nodiscard]] const std::string& fact(const std::string& name) const;
};
// Returns a string that is equal for all observations of one kind. It depends on the cause and the
// names of the changed values, but not on numbers or messages.
[[nodiscard]] std::string kind_of(const Observation& observation);
// Returns whether the observation is about an entry of waivers.json that has no effect.
[[nodiscard]] bool is_about_waiver(const Observation& observation);
// Sets `numbers[name]` to `value`. Does nothing for an infinity or NaN, because JSON cannot
// represent them.
void set_number(Observation& observation, const std::string& name, double value);

// The effect of a waiver, or of a file of expectations (the list of known failures for `validate
// --expect`), on a finding.
struct Excuse {
  enum class Kind : std::uint8_t {
    nothing,
    waived,      // waivers.json lists it
    expired,     // a waiver for it has expired
    known,       // a file of expectations lists it
    unexpected,  // a skip or a pass that the file of expectations does not list
  };
  Kind kind = Kind::nothing;
  ExpectedOutcome outcome = ExpectedOutcome::fail;
  std::string reason = {};
  std::string expiry = {};
};
[[nodiscard]] std::string_view name_of(Excuse::Kind kind);

// The result of a second attempt after a regression.
enum class RetryResult : std::uint8_t {
  not_drawn,
  flake,  // passed the second time
  slow,   // timed out, but passed the second time: the device is slow, or hangs sometimes
  other   // see Finding::retry_observations
};
[[nodiscard]] std::string_view name_of(RetryResult result);

// One result about one configuration on one device. The configuration and the device are empty if
// the finding is about the whole plan.
struct Finding : Observation {
  Check check = Check::image;
  Verdict verdict = Verdict::pass;
  std::string test = {};  // test id, Record::test_id
  std::string device = {};
  std::string configuration = {};
  // For a correlation finding about several configurations: the factor level that these
  // configurations share, such as "step=0.5", or "everything".
  std::string subject = {};
  AdviceWithCommand advice = {};
  std::vector<std::string> injected = {};  // faults that `run --inject` put into the record
  // For a regression on a driver version that was never accepted: the devices on which the
  // configuration was accepted. These may include the same device with another driver version.
  std::vector<std::string> accepted_on = {};
  // For a skip: whether the configuration was measured on the device when the baselines were
  // accepted.
  bool measured_before = false;
  Excuse excuse = {};
  RetryResult retry_result = RetryResult::not_drawn;
  // The finding of the second attempt, if its cause differs from the cause of this finding.
  std::vector<Observation> retry_observations = {};
};
// Like kind_of(const Observation&), but the string also depends on the subject, the excuse (with
// the reason of a waiver), the second attempt and the injected faults.
[[nodiscard]] std::string kind_of(const Finding& finding);
// Returns the topic under which reports list the finding: the name of its check, or "driver" for a
// fault of the device as a whole, or "baselines" if there are no baselines. Neither belongs to a
// check.
[[nodiscard]] std::string_view topic_of(const Finding& finding);
// Returns whether the configuration of the finding ended with an error, a crash, a timeout or a
// lost device.
[[nodiscard]] bool ended_abnormally(const Finding& finding);

}  // namespace triptych::judge
