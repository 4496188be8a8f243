#include "report/words/outcome.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstring>

#include "report/words/detail.hpp"

namespace triptych::report::words {
namespace {

using record::Reason;
using record::Stage;
using record::StatisticWorth;
using record::Worth;

std::string signal_text(int signal) {
  const char* name = ::sigabbrev_np(signal);
  const char* meaning = ::sigdescr_np(signal);
  if (name == nullptr || meaning == nullptr) {
    return fmt::format("the worker was killed by signal {}", signal);
  }
  return fmt::format("the worker was killed by SIG{} ({})", name, meaning);
}

std::string out_of_memory_text(const Reason& reason) {
  std::string text =
      fmt::format("ran out of host memory while using the data set {}", reason.subject);
  if (const auto limit = reason.number("limit_bytes")) {
    text += fmt::format("; the worker may allocate at most {:.0f} MiB", *limit / (1 << 20));
  }
  return text;
}

std::string api_text(const Reason& reason) {
  if (!reason.detail.empty()) return reason.detail;
  return fmt::format("{} returned {}", reason.subject, reason.code);
}

std::string cause_text(const Reason& reason) {
  switch (reason.cause) {
    case record::Cause::none:
      return "measured";
    case record::Cause::same_frames:
    case record::Cause::not_supported:
    case record::Cause::no_emulator:
    case record::Cause::error:
      return reason.detail;
    case record::Cause::not_drawn:
      return with_detail("the driver reported a frame as finished, but did not draw it",
                         reason.detail);
    case record::Cause::bad_input:
      return with_detail("invalid input", reason.detail);
    case record::Cause::not_on_processor:
      return "instructions cannot be counted on this device, because it does not run on the CPU";
    case record::Cause::api_error:
    case record::Cause::device_lost:
      return api_text(reason);
    case record::Cause::out_of_memory:
      return out_of_memory_text(reason);
    case record::Cause::signal:
      return signal_text(static_cast<int>(reason.number("signal").value_or(0)));
    case record::Cause::exit_code:
      return fmt::format("the worker exited with code {:.0f}",
                         reason.number("exit_code").value_or(0));
    case record::Cause::unknown_end:
      return "the worker could not be killed";
    case record::Cause::timeout:
      return fmt::format("no answer within {:g} s", reason.number("limit_s").value_or(0));
    case record::Cause::bad_answer:
      return with_detail(
          "the worker sent an invalid answer, perhaps because it is another version of Triptych",
          reason.detail);
    case record::Cause::no_greeting:
      return "the worker did not report that it had started";
    case record::Cause::cannot_start:
      return with_detail("the worker cannot be started", reason.detail);
    case record::Cause::under_way:
      return fmt::format(
          "Triptych or the machine crashed {:.0f} times while this configuration was being "
          "measured; run without --resume to try it again",
          reason.number("times").value_or(0));
  }
  return {};
}

std::string stage_text(const Reason& reason) {
  switch (reason.stage) {
    case Stage::opening:
      return fmt::format("{} cannot be opened: ", reason.subject);
    case Stage::counting:
      return "while counting instructions under the emulator: ";
    case Stage::working:
      break;
  }
  return {};
}

}  // namespace

std::string text_of(const Reason& reason) {
  std::string text = stage_text(reason) + cause_text(reason);
  if (!reason.last_output.empty()) text += "; the worker's last output: " + reason.last_output;
  if (reason.not_tried) {
    text += fmt::format(
        "; this configuration was not tried, because other configurations{}{} ended in the same "
        "way",
        reason.shared_levels.empty() ? "" : " with ", reason.shared_levels);
  }
  return text;
}

std::string text_of(record::Outcome outcome, const Reason& reason) {
  return with_detail(std::string(record::name_of(outcome)), text_of(reason));
}

std::string text_of(const StatisticWorth& worth) {
  const auto in = [&] { return worth.detail.empty() ? "" : fmt::format(" ({})", worth.detail); };
  switch (worth.worth) {
    case Worth::exact:
      return "exact";
    case Worth::counts:
      return fmt::format(
          "instead of this statistic, the driver reports the value of Triptych's counter '{}'",
          worth.counter);
    case Worth::proportional:
      return fmt::format("always {:.4g} times the correct count", worth.low);
    case Worth::inflated:
      return fmt::format("{:.4g} to {:.4g} times the correct count{}", worth.low, worth.high, in());
    case Worth::differs:
      return "differs from the correct count" + in();
    case Worth::unsteady:
      return "changes when the same frame is drawn again" + in();
    case Worth::absent:
      return "never reported";
    case Worth::unknown:
      return "unknown, because a calibration scene failed" + in();
    case Worth::not_calibrated:
      return "not calibrated";
  }
  return {};
}

}  // namespace triptych::report::words
