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
  improved,      // passes, and is better than the baseline beyond doubt
  advisory,      // information that does not affect the verdict: times, another driver version
  skipped,       // the device cannot do this; the cause has the reason
  waived,        // a known regression, listed in waivers.json or in a file of expectations
  cannot_judge,  // no baseline, nothing measured, other data; never a pass
  regression
};
[[nodiscard]] std::string_view name_of(Verdict verdict);

// Each cause has one sentence. The comments list the data of each cause: numbers in quotes, facts
// in <angles>.
enum class Cause : std::uint8_t {
  none,
  // Of any check.
  as_stored,           // "values" that equal the stored ones; names: those that were not compared
  values_changed,      // changes
  unknown_values,      // names: values without a stored counterpart
  not_stored,          // names: configurations without stored values
  no_stored_device,    // nothing is stored for this device or driver version
  not_reported,        // the device or the technique does not report this kind of value
  no_longer_reported,  // names: configurations that reported it when they were accepted
  untimed,             // the run was not timed, so these values were not read
  // Causes about a run as a whole.
  ended,               // a record that was not measured: outcome, reason
  no_run,              // no run was begun
  nothing_measured,    // <run> <plan> "records"
  no_required_device,  // <glob>
  device_missing,      // <sibling>: a device that was accepted with the same driver version
  listing_failed,      // <what>; reason
  no_description,      // <run>: it has records of a device that it does not describe
  checks_lost,         // names: checks of the baselines that the plan does not ask for
  missing,             // names: configurations without a record; "wanted" of them, <kind>
  extra,               // names: configurations that are not in the plan
  other_plan,          // <run> <plan> <hash> <now>
  other_data,          // <hash> <accepted>: the data differ from those that were accepted
  data_changed,        // <hash> <now>: the data differ from those that were measured
  no_baselines,        // <folder>
  nothing_decided,     // of a device
  device_fault,   // observed outside of any configuration: <kind> <subject> <last_words>; detail
  unused_waiver,  // expired, and excuses nothing: <test> <device> <expiry> <reason>
  waiver_of_no_test,  // <test>
  // Of images.
  within_bound,
  pixels_over_bound,
  not_finite,
  other_surface,  // another particle is visible, or the right one at another depth
  size_differs,
  empty_image,
  no_image,           // the record contains none
  unreadable_image,   // detail
  no_reference,       // detail
  reference_changed,  // because: how; if empty: its hash changed
  reference_as_stored,
  devices_agree,     // <other> "rms" "allowed"
  devices_disagree,  // as for devices_agree
  // Of statistics.
  other_driver_statistics,  // <driver_version> changes names
  // Causes about cost and memory.
  two_counters,       // <counted_by> <other>
  other_counter,      // <counted_by> <other> <driver_version> <other_version>
  frame_allocations,  // changed; "configurations", <configuration>, changes: the largest
  preparing,          // likewise
  injected_memory,    // an injected slowdown allocates memory itself
  // Code of GPUs.
  other_executables,  // names: those that only one of the two was compiled in
  other_disassembly,  // names: configurations whose statistics did not change
  other_compiler,  // <driver_version> <other_version> "configurations" "changed"; changes: totals
  // Of times.
  time,         // "median_ns" "baseline_ns" "ratio" "half_width"
  times,        // over all configurations of a device
  other_clock,  // names
  no_time,
  same_frames,  // reason
  wrong_image,  // because: the errors in the image
  // Of correlations.
  residuals_as_stored,  // names: devices
  residual_moved,       // names: devices
  off_the_line,         // <other>
  on_the_line,          // <other>
  no_line,              // <other> "refusal"
  no_partner,           // <counted_by>
  // Of accuracy.
  error,              // "rmse" "bound"
  unknown_error,      // detail
  not_comparable,     // the sizes differ, or a value is not finite
  no_limit,           // no scene of the plan has a limit
  no_limit_any_more,  // an error is stored for a scene that has no limit now
  order,              // "order" "half_width" "stored_order" "stored_half_width"
  no_order,           // "stored_order" "stored_half_width"
  // Of stress cases.
  score,           // "score" "accepted"; because: what lost the points
  farther_device,  // <other> "rms" "allowed" "rmse" "rmse_of_other"
  pixels_differ,   // <levels> of the other image; detail: what is expected
  no_other_image,  // <levels>; detail
  not_inside,      // detail; this image is not a part of the other one
  other_colour,    // detail
  not_counted,     // detail; <counter> <levels>
  count_too_large  // detail; <counter> <of> <levels> "count" "factor" "unit"
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

// The next step for the reader.
enum class Advice : std::uint8_t {
  none,
  accept,  // with `command`
  run_again,
  resume,        // with `command`
  restore_data,  // or accept with `command`
  restore_or_run_again,
  restore_baselines,  // from version control, or begin anew with `command`
  count,              // or leave the check out
  judge_more,         // or accept with `command`
  more_time,          // a longer --limit
  times,              // --times makes times decide
  repair_driver,      // or state with `command` that the machine lacks it
  remove_entry,       // from the file of expectations
  remove_waiver
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
// This text is equal for observations with one cause, whatever their numbers and texts are.
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
  flake,  // right the second time
  slow,   // a timeout that passed the second time: the device is slow, or hangs at times
  other   // see Finding::again
};
[[nodiscard]] std::string_view name_of(Again again);

// One result about one configuration on one device. Both are empty if the finding is about the
// whole plan.
struct Finding : Observation {
  Check check = Check::image;
  Verdict verdict = Verdict::pass;
  std::string test = {};  // test id, Record::test_id
  std::string device = {};
  std::string configuration = {};
  // The part of the device and configuration that the finding is about, if it is not about all:
  // "program", "step=0.5". For a correlation it also contains the other device.
  std::string subject = {};
  Advised advice = {};
  std::vector<std::string> injected = {};  // faults that `run --inject` put into it
  // For a regression on a driver version that was never accepted: the accepted devices that have
  // its configuration, which may include the same device with another version.
  std::vector<std::string> accepted_on = {};
  bool measured_before = false;  // for a skip: the device measured it when it was accepted
  Excuse excuse = {};
  Again drawn_again = Again::not_drawn;
  // The finding of the second attempt, if its cause is another one.
  std::vector<Observation> again = {};
};
// The same, with the excuse and the injected faults.
[[nodiscard]] std::string kind_of(const Finding& finding);
// Whether the finding is about a program that ended by an error, a crash, a timeout or a lost
// device.
[[nodiscard]] bool ended_a_program(const Finding& finding);

}  // namespace triptych::judge
