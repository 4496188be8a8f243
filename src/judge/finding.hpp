#pragma once
// Findings of the judge, as data. report/words/ turns each cause into a sentence. Nothing compares
// `detail`, which quotes drivers, libraries and people. docs/report.md lists the causes for other
// programs.

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
  advisory,      // information that does not affect the verdict: times, another driver version
  skipped,       // the device cannot do this; the cause has the reason
  waived,        // a known regression, listed in waivers.json or in a file of expectations
  cannot_judge,  // no baseline, nothing measured, other data; never a pass
  regression
};
[[nodiscard]] std::string_view name_of(Verdict verdict);

// The reason for a verdict. report/words/ has one sentence for each cause. A comment with brackets
// lists the data of the cause: numbers in quotes, facts in <angles>, other members by their names.
enum class Cause : std::uint8_t {
  none,

  // Causes of any check.
  as_stored,           // the values equal the stored ones ["values"; names: values not compared]
  values_changed,      // values differ from the stored ones [changes]
  unknown_values,      // values have no stored counterpart [names]
  not_stored,          // nothing is stored for some configurations [names]
  no_stored_device,    // nothing is stored for this device or driver version
  not_reported,        // the device or the technique does not report this kind of value
  no_longer_reported,  // values are missing that existed when they were accepted [names]
  untimed,             // the values were not read, because the run was not timed

  // Causes about a run as a whole.
  ended,               // the configuration was not measured [outcome, reason]
  no_run,              // no run was begun
  nothing_measured,    // the run has no measured record [<run> <plan> "records"]
  no_required_device,  // no measured device matches a required glob [<glob>, detail, reason]
  device_missing,      // a device is gone that was accepted with this driver version of [<sibling>]
  listing_failed,      // devices could not be listed [<what>, reason]
  no_description,      // the run has records of a device that it does not describe [<run>]
  checks_lost,         // the baselines have checks that the plan does not request [names]
  missing,             // configurations have no record [names; "wanted": number required, <kind>]
  extra,               // the run has configurations that are not in the plan [names]
  other_plan,          // the run measured another version of the plan [<run> <plan> <hash> <now>]
  other_data,          // the data differ from the accepted ones [<hash> <accepted>]
  data_changed,        // the data have changed since they were measured [<hash> <now>]
  no_baselines,        // there are no baselines [<folder>]
  nothing_decided,     // no check reached a verdict for the device
  device_fault,   // a fault outside of any configuration [<kind> <subject> <last_words>, detail]
  unused_waiver,  // a waiver has expired and excuses nothing [<test> <device> <expiry>, detail]
  waiver_of_no_test,  // a waiver matches no test [<test>]

  // Causes about images.
  within_bound,
  pixels_over_bound,
  not_finite,
  other_surface,  // another particle is visible, or the right one at another depth
  size_differs,
  empty_image,
  no_image,           // the record has no image
  unreadable_image,   // the stored image cannot be read [detail]
  no_reference,       // there is no reference image [detail]
  reference_changed,  // the reference image is not the accepted one [because: the differences]
  reference_as_stored,
  devices_agree,     // the images of two devices agree [<device> <other> "rms" "allowed"]
  devices_disagree,  // the images of two devices differ [<device> <other> "rms" "allowed"]

  // Causes about statistics.
  other_driver_statistics,  // compared with other drivers only [<driver_version>, changes, names]

  // Causes about cost and memory.
  two_counters,       // two emulators counted the run [<counted_by> <other>]
  other_counter,      // the stored cost is of another driver version or by another emulator
  frame_allocations,  // a frame's allocations changed [<configuration>, changes: the largest]
  preparing,          // the cost of preparing changed [<configuration>, changes: the largest]
  injected_memory,    // not compared, because an injected slowdown allocates memory itself

  // Causes about the code for GPUs.
  other_executables,  // the configuration consists of other executables [names]
  other_disassembly,  // only the disassembly changed, not the statistics [names: configurations]
  other_compiler,     // the stored code is by another compiler [<driver_version> <other_version>]

  // Causes about times.
  time,         // one configuration ["median_ns" "baseline_ns" "ratio" "half_width"]
  times,        // all configurations of a device ["ratio": the median, "worst_ratio"]
  other_clock,  // the stored times are by another clock [names]
  no_time,
  same_frames,  // not timed, because an equivalent configuration was [reason]
  wrong_image,  // the time has no meaning [because: the errors in the image]

  // Causes about correlations.
  residuals_as_stored,  // the cost ratios to other devices are unchanged [names: devices]
  residual_moved,       // the cost ratios to other devices changed [names: devices]
  off_the_line,         // the line of another device predicts another cost [<other>]
  on_the_line,          // the line of another device predicts this cost [<other>]
  no_line,              // there is no valid line [<other> <refusal>]
  no_partner,           // no other device has a cost by the same emulator [<counted_by>]

  // Causes about accuracy.
  error,              // the error against the limit image ["rmse" "bound"]
  unknown_error,      // the error cannot be measured [detail]
  not_comparable,     // the sizes differ, or a value is not finite
  no_limit,           // no scene of the plan has a limit image
  no_limit_any_more,  // an error is stored for a scene that has no limit image now
  order,              // the order of convergence ["order" "half_width" "stored_order" …]
  no_order,           // no order can be fitted any more ["stored_order" "stored_half_width"]

  // Causes about stress cases.
  score,  // the points of a case ["score" "accepted"; because: the reasons for lost points]
  farther_device,  // an image nearer to the reference image differs [<other> "rms" "allowed"]
  pixels_differ,   // two images of the case should be equal [<levels> of the other image]
  no_other_image,  // the other image of an expectation is missing [<levels>]
  not_inside,      // this image is not a part of the other image [<levels>]
  other_colour,    // a pixel does not have the expected colour
  not_counted,     // a counter of an expectation is missing [<counter> <levels>]
  count_too_large  // a count exceeds "factor" times "unit" [<counter> <of> <levels> "count"]
};
[[nodiscard]] std::string_view name_of(Cause cause);

// The other side of the comparison.
enum class Against : std::uint8_t {
  nothing,
  reference,      // the reference image
  stored_image,   // the image that was accepted
  baseline,       // accepted values of the same driver version
  other_devices,  // accepted values of other devices or driver versions
  expectation,    // the expectation of a stress case
};
[[nodiscard]] std::string_view name_of(Against against);

// The next step that a finding recommends. `command` is Advised::command.
enum class Advice : std::uint8_t {
  none,
  accept,                // accept the values with `command`
  run_again,             // run the plan again
  resume,                // finish the run with `command`
  restore_data,          // restore the data and run again, or accept with `command`
  restore_or_run_again,  // restore the data, or run again
  restore_baselines,     // restore them from version control, or start over with `command`
  count,                 // count instructions, or leave out the check
  judge_more,            // judge more checks, or accept with `command`
  more_time,             // use a longer --limit
  times,                 // use --times if times should affect the verdict
  repair_driver,         // repair it, or state with `command` that the machine lacks the device
  remove_entry,          // remove the entry from the file of expectations
  remove_waiver          // remove the waiver
};
[[nodiscard]] std::string_view name_of(Advice advice);

struct Advised {
  Advice advice = Advice::none;
  std::string command = {};
};

enum class Unit : std::uint8_t { count, instructions, bytes, misses, allocations };
[[nodiscard]] std::string_view name_of(Unit unit);

// A value that differs from the one with which it was compared.
struct Change {
  std::string name;
  Unit unit = Unit::count;
  std::optional<double> before = {};            // empty: there was no such value
  std::optional<double> now = {};               // empty: it is missing
  std::map<std::string, double> accepted = {};  // by device, if it was compared with several
  double allowed = 0;                           // the allowed difference
};

struct Observation {
  Cause cause = Cause::none;
  Against against = Against::nothing;
  std::map<std::string, double> numbers = {};  // finite; the unit is part of the name
  std::vector<Change> changes = {};
  std::vector<std::string> names = {};            // names of configurations, values or devices
  std::map<std::string, std::string> facts = {};  // identifiers
  std::string detail = {};                        // the message of a library or an exception
  record::Outcome outcome = record::Outcome::measured;
  record::Reason reason = {};
  std::vector<Observation> because = {};

  [[nodiscard]] double number(const std::string& name) const;  // 0 if there is no such number
  [[nodiscard]] const std::string& fact(const std::string& name) const;
};
// Returns a text that is equal for all observations with the same cause, independent of their
// numbers and texts.
[[nodiscard]] std::string kind_of(const Observation& what);
// Infinities and NaN are left out: JSON cannot express them, and missing is not zero.
void set_number(Observation& what, const std::string& name, double value);

// The effect of a waiver or a file of expectations on a finding.
struct Excuse {
  enum class Of : std::uint8_t {
    nothing,
    waived,      // waivers.json lists it
    expired,     // a waiver for it has expired
    known,       // a file of expectations lists it
    unexpected,  // a skip or a pass that the file does not expect
  };
  Of of = Of::nothing;
  Known known = Known::fail;
  std::string reason = {};
  std::string expiry = {};
};
[[nodiscard]] std::string_view name_of(Excuse::Of of);

// The result of a second attempt after a regression.
enum class Again : std::uint8_t {
  not_drawn,
  flake,  // passed the second time
  slow,   // timed out, and passed the second time: the device is slow, or hangs sometimes
  other   // see Finding::again
};
[[nodiscard]] std::string_view name_of(Again again);

// One result about one configuration on one device. The configuration and the device are empty if
// the finding is about the whole plan.
struct Finding : Observation {
  Check check = Check::image;
  Verdict verdict = Verdict::pass;
  std::string test = {};  // test id, Record::test_id
  std::string device = {};
  std::string configuration = {};
  // The part of the device or configuration that the finding is about, if it is not about the
  // whole: "program", "step=0.5". For a correlation it also contains the other device.
  std::string subject = {};
  Advised advice = {};
  std::vector<std::string> injected = {};  // faults that `run --inject` put into it
  // For a regression on a driver version that was never accepted: the devices on which the
  // configuration was accepted. These may include the same device with another driver version.
  std::vector<std::string> accepted_on = {};
  bool measured_before = false;  // for a skip: the device measured it when it was accepted
  Excuse excuse = {};
  Again drawn_again = Again::not_drawn;
  // The finding of the second attempt, if its cause is another one.
  std::vector<Observation> again = {};
};
// As above, but the text also depends on the excuse and the injected faults.
[[nodiscard]] std::string kind_of(const Finding& finding);
// Whether the finding is about a configuration that ended with an error, a crash, a timeout or a
// lost device.
[[nodiscard]] bool ended_a_program(const Finding& finding);

}  // namespace triptych::judge
