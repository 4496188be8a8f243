// Contains a sentence for each cause.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/words/causes.hpp"
#include "report/words/detail.hpp"
#include "report/words/finding.hpp"
#include "report/words/outcome.hpp"

namespace triptych::report::words {
namespace {

using judge::Against;
using judge::Cause;
using judge::Observation;

// Returns at most three of the names: "A; B; C; …".
std::string first_names(const std::vector<std::string>& names) {
  const auto named = std::min<std::ptrdiff_t>(std::ssize(names), 3);
  const std::vector<std::string> first(names.begin(), names.begin() + named);
  return fmt::format("{}{}", fmt::join(first, "; "), std::ssize(names) > named ? "; …" : "");
}

std::string nothing_measured(const Observation& what) {
  return fmt::format(
      "nothing was measured: run {} has {} for {}, but no measurement on any of the requested "
      "devices",
      what.fact("run"), counted(what.number("records"), "record", "records"), what.fact("plan"));
}

std::string missing(const Observation& what) {
  return fmt::format("{} of {:.0f} {} configurations have no record: {}", what.names.size(),
                     what.number("wanted"), what.fact("kind"), first_names(what.names));
}

std::string other_plan(const Observation& what) {
  const std::string measured = what.fact("hash");
  return fmt::format(
      "run {} measured a different version of plan {} ({})", what.fact("run"), what.fact("plan"),
      measured.empty() ? "the run contains no plan hash"
                       : fmt::format("plan hash {}, now {}", measured, what.fact("now")));
}

std::string no_longer_reported(const Observation& what) {
  if (what.names.empty()) return "the baselines contain values that this run does not report";
  return fmt::format("for {}, the baselines contain values that this run does not report",
                     examples(what.names));
}

std::string not_stored(const Observation& what) {
  if (what.names.empty()) return "there is no stored value to compare with";
  return fmt::format("there are no stored values for {}", examples(what.names));
}

std::string changed_in(const Observation& what, std::string_view which) {
  std::string text =
      fmt::format("{} changed in {}", which,
                  counted(what.number("configurations"), "configuration", "configurations"));
  if (!what.changes.empty()) {
    text += fmt::format("; largest change in {}: {}", what.fact("configuration"),
                        text_of(what.changes.front()));
  }
  return text;
}

std::string no_stored_device(const Observation& what) {
  if (what.fact("device_key").empty()) return "nothing is stored for this device";
  return fmt::format("nothing is stored for this device: {}", what.fact("device_key"));
}

std::string_view fault_text(record::DeviceFaultKind kind) {
  switch (kind) {
    case record::DeviceFaultKind::clock_reads_zero:
      return "the device's clock always reads 0";
    case record::DeviceFaultKind::clock_rate_wrong:
      return "the device's clock does not run at the rate that the driver reports";
    case record::DeviceFaultKind::clock_not_written:
      return "the driver never writes the requested timestamps";
    case record::DeviceFaultKind::statistics_all_zero:
      return "all pipeline statistics are 0, even for frames that draw something";
    case record::DeviceFaultKind::statistics_crash:
      return "the driver crashes when pipeline statistics are read, so everything else was "
             "measured without them";
    case record::DeviceFaultKind::statistics_not_ready:
      return "pipeline statistics do not become available, although Triptych waits for them, so "
             "everything else was measured without them";
    case record::DeviceFaultKind::teardown_crash:
      return "the driver crashes when the device is closed or the process exits";
    case record::DeviceFaultKind::teardown_hang:
      return "the driver hangs when the device is closed or the process exits";
    case record::DeviceFaultKind::memory_grows:
      return "the memory usage of the process grows each time the same configurations are drawn, "
             "so the "
             "driver does not free all of its memory";
  }
  return {};
}

std::string device_fault(const Observation& what) {
  std::string text{fault_text(record::device_fault_kind(what.fact("kind")))};
  if (!what.fact("subject").empty()) text += fmt::format(" ({} work)", what.fact("subject"));
  text = with_detail(text, what.detail);
  if (!what.fact("last_words").empty()) {
    text += fmt::format("; the worker's last output: {}", what.fact("last_words"));
  }
  return text;
}

std::string no_baselines(const Observation& what) {
  if (!what.detail.empty()) return fmt::format("{}: {}", what.fact("folder"), what.detail);
  const std::string& folder = what.fact("folder");
  std::string text = folder.empty() ? "there are no baselines for this plan"
                                    : fmt::format("there are no baselines in {}", folder);
  if (what.names.empty()) return text;
  const std::string& checked = what.fact("checked");
  text += checked.empty() ? std::string(", so nothing was checked")
                          : fmt::format(", so only these checks were made: {}", checked);
  return text + fmt::format("; these checks need baselines: {}", fmt::join(what.names, ", "));
}

std::string not_counted(const Observation& what) {
  std::string text = fmt::format("the counter '{}' is missing", what.fact("counter"));
  if (!what.fact("levels").empty()) text += " for " + what.fact("levels");
  return text;
}

std::string no_required_device(const Observation& what) {
  const std::string text = with_detail(
      fmt::format("a device that matches {} is required, but none was measured", what.fact("glob")),
      what.detail);
  return what.reason.cause == record::Cause::none ? text : with_detail(text, text_of(what.reason));
}

std::string unused_waiver(const Observation& what) {
  std::string text = fmt::format("the waiver for {} on {}", what.fact("test"), what.fact("device"));
  if (const std::string& some = what.fact("configuration"); !some.empty() && some != "*") {
    text += fmt::format(" in {}", some);
  }
  if (what.numbers.contains("expired")) {
    return text + fmt::format(" expired on {} and no longer excuses anything ({})",
                              what.fact("expiry"), what.detail);
  }
  return text + fmt::format(" excuses nothing in this run ({})", what.detail);
}

std::string sentence_of(const Observation& what) {
  switch (what.cause) {
    case Cause::none:
      return {};
    case Cause::as_stored:
      return as_stored(what);
    case Cause::values_changed:
      return values_changed(what);
    case Cause::unknown_values:
      return fmt::format("there is no stored value for {}", fmt::join(what.names, ", "));
    case Cause::not_stored:
      return not_stored(what);
    case Cause::no_stored_device:
      return no_stored_device(what);
    case Cause::not_reported:
      return "the device or technique does not report these values";
    case Cause::no_longer_reported:
      return no_longer_reported(what);
    case Cause::untimed:
      return "not measured, because the run was untimed";
    case Cause::ended:
      return text_of(what.outcome, what.reason);
    case Cause::no_run:
      return "nothing was measured: no run was started";
    case Cause::nothing_measured:
      return nothing_measured(what);
    case Cause::no_required_device:
      return no_required_device(what);
    case Cause::device_missing:
      return fmt::format(
          "this device was not found, although its baselines were accepted on a machine with the "
          "same {} driver version as this machine",
          what.fact("sibling"));
    case Cause::listing_failed:
      return fmt::format("device enumeration failed for {}, so devices may be missing: {}",
                         what.fact("what"), text_of(what.reason));
    case Cause::no_description:
      return fmt::format(
          "run {} has records for this device, but the store lacks the rows that describe the "
          "device",
          what.fact("run"));
    case Cause::checks_lost:
      return fmt::format("the baselines contain checks that the plan no longer requests: {}",
                         fmt::join(what.names, ", "));
    case Cause::missing:
      return missing(what);
    case Cause::extra:
      return fmt::format("the run contains {} that are not in the plan", examples(what.names));
    case Cause::other_plan:
      return other_plan(what);
    case Cause::other_data:
      return fmt::format(
          "the input data differ from the data accepted under this name (content hash {}, accepted "
          "{})",
          what.fact("hash"), what.fact("accepted"));
    case Cause::data_changed:
      return fmt::format(
          "the input data have changed since this measurement (content hash {}, now {})",
          what.fact("hash"), what.fact("now"));
    case Cause::no_baselines:
      return no_baselines(what);
    case Cause::device_fault:
      return device_fault(what);
    case Cause::nothing_decided:
      return "no check reached a verdict for this device: there were only advisories and skips";
    case Cause::unused_waiver:
      return unused_waiver(what);
    case Cause::waiver_of_no_plan:
      return fmt::format(
          "the waiver for {} names the plan {}, which does not exist; a test id has the form "
          "SUITE.PLAN.CHECK.DEVICE",
          what.fact("test"), what.fact("plan"));
    case Cause::waiver_of_no_test:
      return fmt::format(
          "the waiver for {} matches no test; a test id has the form SUITE.PLAN.CHECK.DEVICE; to "
          "limit a waiver to some configurations, use the key `configuration`",
          what.fact("test"));
    case Cause::within_bound:
      return within_bound(what);
    case Cause::pixels_over_bound:
      return pixels_over_bound(what);
    case Cause::not_finite:
      return not_finite(what);
    case Cause::other_surface:
      return other_surface(what);
    case Cause::size_differs:
      return size_differs(what);
    case Cause::empty_image:
      return "the image has no pixels";
    case Cause::no_image:
      return "the record has no image";
    case Cause::unreadable_image:
      return with_detail("the stored image cannot be read", what.detail);
    case Cause::no_reference:
      return with_detail("there is no reference image to compare with", what.detail);
    case Cause::reference_changed:
      return reference_changed(what);
    case Cause::reference_as_stored:
      return "the reference image has not changed since it was accepted";
    case Cause::devices_agree:
    case Cause::devices_disagree:
      return devices_compared(what);
    case Cause::other_driver_statistics:
      return other_driver_statistics(what);
    case Cause::two_counters:
      return fmt::format(
          "the instruction counts are not comparable, because {} counted some of them and {} the "
          "others",
          what.fact("counted_by"), what.fact("other"));
    case Cause::other_counter:
      return other_counter(what);
    case Cause::frame_allocations:
      return changed_in(what, "the number of allocations per frame");
    case Cause::preparing:
      return changed_in(what, "the number of driver instructions during preparation");
    case Cause::injected_memory:
      return "not compared, because the injected slowdown itself allocates memory";
    case Cause::other_executables:
      return fmt::format(
          "shaders or kernels were added or removed since the baseline was accepted: {}",
          fmt::join(what.names, ", "));
    case Cause::other_disassembly:
      return fmt::format("the disassembly of {} changed, but the code statistics did not",
                         examples(what.names));
    case Cause::other_compiler:
      return other_compiler(what);
    case Cause::time:
      return time(what);
    case Cause::times:
      return times(what);
    case Cause::other_clock:
      return fmt::format("the stored times of {} were measured with a different clock",
                         examples(what.names));
    case Cause::no_time:
      return "no time was measured";
    case Cause::same_frames:
      return with_detail("not timed, because another configuration draws the same frames",
                         text_of(what.reason));
    case Cause::wrong_image:
      return what.because.empty()
                 ? "the time is meaningless, because the image is wrong"
                 : fmt::format("the time is meaningless, because the image is wrong: {}",
                               text_of(what.because.front()));
    case Cause::residuals_as_stored:
      return fmt::format("the cost ratios of this device to {} agree with the stored ratios in {}",
                         fmt::join(what.names, ", "),
                         counted(what.number("configurations"), "configuration", "configurations"));
    case Cause::residual_moved:
      return residual_moved(what);
    case Cause::off_the_line:
      return off_the_line(what);
    case Cause::on_the_line:
      return on_the_line(what);
    case Cause::no_line:
      return no_line(what);
    case Cause::no_partner:
      return fmt::format(
          "the cost of this device cannot be correlated with that of another device, because no "
          "other device has a stored cost counted by {}",
          what.fact("counted_by"));
    case Cause::error:
      return error(what);
    case Cause::unknown_error:
      return with_detail("the error of the image cannot be measured", what.detail);
    case Cause::not_comparable:
      return "the image cannot be compared, because its size differs or it has non-finite values";
    case Cause::no_limit:
      return "errors cannot be measured, because no scene of this plan has a limit image (the "
             "image for a step size of 0)";
    case Cause::no_limit_any_more:
      return "the baselines store the image error that was measured against this scene's limit "
             "image (the image for a step size of 0), but the scene no longer has a limit image";
    case Cause::order:
    case Cause::no_order:
      return order(what);
    case Cause::score:
      return score(what);
    case Cause::farther_device:
      return farther_device(what);
    case Cause::pixels_differ:
      return pixels_differ(what);
    case Cause::no_other_image:
      return fmt::format("there is no image with {} to compare with", what.fact("levels"));
    case Cause::not_inside:
      return not_inside(what);
    case Cause::other_colour:
      return other_colour(what);
    case Cause::not_counted:
      return not_counted(what);
    case Cause::count_too_large:
      return count_too_large(what);
  }
  return {};
}

}  // namespace

std::string counted(double n, std::string_view one, std::string_view many) {
  return fmt::format("{:.0f} {}", n, n == 1 ? one : many);
}

std::string examples(const std::vector<std::string>& configurations) {
  return fmt::format(
      "{} ({})",
      counted(static_cast<double>(configurations.size()), "configuration", "configurations"),
      first_names(configurations));
}

std::string percent(double ratio) {
  if (ratio > 2) return fmt::format("{:.3g} times", ratio);
  return fmt::format("{:+.3g} %", 100 * (ratio - 1));
}

std::string_view text_of(Against against) {
  switch (against) {
    case Against::nothing:
      return "nothing";
    case Against::reference:
      return "the reference image";
    case Against::stored_image:
      return "the accepted image";
    case Against::baseline:
      return "the stored values";
    case Against::other_devices:
      return "other devices";
    case Against::expectation:
      return "the expected result";
  }
  return {};
}

std::string text_of(const Observation& what) {
  std::string text = sentence_of(what);
  if (what.against == Against::expectation) {
    text = fmt::format("expected: {}; {}", what.detail, text);
  }
  return text;
}

}  // namespace triptych::report::words
