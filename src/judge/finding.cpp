#include "judge/finding.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "record/names.hpp"

namespace triptych::judge {
namespace {

using record::Names;

constexpr Names<Verdict, 7> verdict_names{{
    {Verdict::pass, "pass"},
    {Verdict::improved, "improved"},
    {Verdict::advisory, "advisory"},
    {Verdict::skipped, "skipped"},
    {Verdict::waived, "waived"},
    {Verdict::cannot_judge, "cannot_judge"},
    {Verdict::regression, "regression"},
}};

constexpr Names<Cause, 77> cause_names{{
    {Cause::none, "none"},
    {Cause::as_stored, "as_stored"},
    {Cause::values_changed, "values_changed"},
    {Cause::unknown_values, "unknown_values"},
    {Cause::not_stored, "not_stored"},
    {Cause::no_stored_device, "no_stored_device"},
    {Cause::not_reported, "not_reported"},
    {Cause::no_longer_reported, "no_longer_reported"},
    {Cause::untimed, "untimed"},
    {Cause::ended, "ended"},
    {Cause::no_run, "no_run"},
    {Cause::nothing_measured, "nothing_measured"},
    {Cause::no_required_device, "no_required_device"},
    {Cause::device_missing, "device_missing"},
    {Cause::listing_failed, "listing_failed"},
    {Cause::no_description, "no_description"},
    {Cause::checks_lost, "checks_lost"},
    {Cause::missing, "missing"},
    {Cause::extra, "extra"},
    {Cause::other_plan, "other_plan"},
    {Cause::other_data, "other_data"},
    {Cause::data_changed, "data_changed"},
    {Cause::no_baselines, "no_baselines"},
    {Cause::nothing_decided, "nothing_decided"},
    {Cause::device_fault, "device_fault"},
    {Cause::unused_waiver, "unused_waiver"},
    {Cause::waiver_of_no_test, "waiver_of_no_test"},
    {Cause::waiver_of_no_plan, "waiver_of_no_plan"},
    {Cause::within_bound, "within_bound"},
    {Cause::pixels_over_bound, "pixels_over_bound"},
    {Cause::not_finite, "not_finite"},
    {Cause::other_surface, "other_surface"},
    {Cause::size_differs, "size_differs"},
    {Cause::empty_image, "empty_image"},
    {Cause::no_image, "no_image"},
    {Cause::unreadable_image, "unreadable_image"},
    {Cause::no_reference, "no_reference"},
    {Cause::reference_changed, "reference_changed"},
    {Cause::reference_as_stored, "reference_as_stored"},
    {Cause::devices_agree, "devices_agree"},
    {Cause::devices_disagree, "devices_disagree"},
    {Cause::other_driver_statistics, "other_driver_statistics"},
    {Cause::two_counters, "two_counters"},
    {Cause::other_counter, "other_counter"},
    {Cause::frame_allocations, "frame_allocations"},
    {Cause::preparing, "preparing"},
    {Cause::injected_memory, "injected_memory"},
    {Cause::other_executables, "other_executables"},
    {Cause::other_disassembly, "other_disassembly"},
    {Cause::other_compiler, "other_compiler"},
    {Cause::time, "time"},
    {Cause::times, "times"},
    {Cause::other_clock, "other_clock"},
    {Cause::no_time, "no_time"},
    {Cause::same_frames, "same_frames"},
    {Cause::wrong_image, "wrong_image"},
    {Cause::residuals_as_stored, "residuals_as_stored"},
    {Cause::residual_moved, "residual_moved"},
    {Cause::off_the_line, "off_the_line"},
    {Cause::on_the_line, "on_the_line"},
    {Cause::no_line, "no_line"},
    {Cause::no_partner, "no_partner"},
    {Cause::error, "error"},
    {Cause::unknown_error, "unknown_error"},
    {Cause::not_comparable, "not_comparable"},
    {Cause::no_limit, "no_limit"},
    {Cause::no_limit_any_more, "no_limit_any_more"},
    {Cause::order, "order"},
    {Cause::no_order, "no_order"},
    {Cause::score, "score"},
    {Cause::farther_device, "farther_device"},
    {Cause::pixels_differ, "pixels_differ"},
    {Cause::no_other_image, "no_other_image"},
    {Cause::not_inside, "not_inside"},
    {Cause::other_colour, "other_colour"},
    {Cause::not_counted, "not_counted"},
    {Cause::count_too_large, "count_too_large"},
}};

constexpr Names<Against, 6> against_names{{
    {Against::nothing, "nothing"},
    {Against::reference, "reference"},
    {Against::stored_image, "stored_image"},
    {Against::baseline, "baseline"},
    {Against::other_devices, "other_devices"},
    {Against::expectation, "expectation"},
}};

constexpr Names<Advice, 16> advice_names{{
    {Advice::none, "none"},
    {Advice::accept, "accept"},
    {Advice::accept_or_compare, "accept_or_compare"},
    {Advice::accept_own, "accept_own"},
    {Advice::run_again, "run_again"},
    {Advice::resume, "resume"},
    {Advice::restore_data, "restore_data"},
    {Advice::restore_or_run_again, "restore_or_run_again"},
    {Advice::restore_baselines, "restore_baselines"},
    {Advice::count, "count"},
    {Advice::judge_more, "judge_more"},
    {Advice::more_time, "more_time"},
    {Advice::times, "times"},
    {Advice::repair_driver, "repair_driver"},
    {Advice::remove_entry, "remove_entry"},
    {Advice::remove_waiver, "remove_waiver"},
}};

constexpr Names<Unit, 5> unit_names{{
    {Unit::count, "count"},
    {Unit::instructions, "instructions"},
    {Unit::bytes, "bytes"},
    {Unit::misses, "misses"},
    {Unit::allocations, "allocations"},
}};

constexpr Names<RetryResult, 4> retry_result_names{{
    {RetryResult::not_drawn, "not_drawn"},
    {RetryResult::flake, "flake"},
    {RetryResult::slow, "slow"},
    {RetryResult::other, "other"},
}};

constexpr Names<Excuse::Kind, 5> excuse_names{{
    {Excuse::Kind::nothing, "nothing"},
    {Excuse::Kind::waived, "waived"},
    {Excuse::Kind::expired, "expired"},
    {Excuse::Kind::known, "known"},
    {Excuse::Kind::unexpected, "unexpected"},
}};

}  // namespace

std::string_view name_of(Excuse::Kind kind) {
  return record::name_in(excuse_names, kind);
}
std::string_view name_of(Verdict verdict) {
  return record::name_in(verdict_names, verdict);
}
std::string_view name_of(Cause cause) {
  return record::name_in(cause_names, cause);
}
std::string_view name_of(Against against) {
  return record::name_in(against_names, against);
}
std::string_view name_of(Advice advice) {
  return record::name_in(advice_names, advice);
}
std::string_view name_of(Unit unit) {
  return record::name_in(unit_names, unit);
}
std::string_view name_of(RetryResult result) {
  return record::name_in(retry_result_names, result);
}

double Observation::number(const std::string& name) const {
  const auto found = numbers.find(name);
  return found == numbers.end() ? 0 : found->second;
}

const std::string& Observation::fact(const std::string& name) const {
  static const std::string none;
  const auto found = facts.find(name);
  return found == facts.end() ? none : found->second;
}

void set_number(Observation& observation, const std::string& name, double value) {
  if (std::isfinite(value)) observation.numbers[name] = value;
}

std::string kind_of(const Observation& observation) {
  std::string kind = fmt::format("{} {}", name_of(observation.cause), name_of(observation.against));
  if (observation.outcome != record::Outcome::measured) {
    kind += fmt::format(" {} {}", record::name_of(observation.outcome),
                        record::kind_of(observation.reason));
  }
  const bool alone = observation.changes.size() == 1;
  for (const Change& each : observation.changes) {
    // The kind does not name cache misses, unless they are the only change, because they often
    // increase only as a consequence of the other changes.
    if (each.unit == Unit::misses && !alone) continue;
    kind += " " + each.name;
  }
  if (observation.cause == Cause::device_fault) kind += " " + observation.fact("kind");
  if (is_about_waiver(observation)) {
    kind += fmt::format(" {} {} {}", observation.fact("test"), observation.fact("device"),
                        observation.fact("configuration"));
  }
  if (observation.cause == Cause::unknown_values)
    kind += fmt::format(" {}", fmt::join(observation.names, " "));
  for (const Observation& each : observation.because) kind += "; " + kind_of(each);
  return kind;
}

std::string kind_of(const Finding& finding) {
  std::string kind =
      fmt::format("{}, {} {} {} {}", kind_of(static_cast<const Observation&>(finding)),
                  finding.subject, name_of(finding.excuse.kind), name_of(finding.retry_result),
                  fmt::join(finding.injected, "+"));
  // The final terminal output shows one reason and one date for each group of waived findings.
  if (finding.excuse.kind == Excuse::Kind::waived) {
    kind += fmt::format(" {} {}", finding.excuse.expiry, finding.excuse.reason);
  }
  return kind;
}

bool is_about_waiver(const Observation& observation) {
  return observation.cause == Cause::unused_waiver ||
         observation.cause == Cause::waiver_of_no_test ||
         observation.cause == Cause::waiver_of_no_plan;
}

std::string_view topic_of(const Finding& finding) {
  if (finding.cause == Cause::device_fault) return "driver";
  return finding.cause == Cause::no_baselines ? "baselines" : name_of(finding.check);
}

bool ended_abnormally(const Finding& finding) {
  return finding.cause == Cause::ended && finding.outcome != record::Outcome::skipped;
}

}  // namespace triptych::judge
