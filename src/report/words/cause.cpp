#include "report/words/cause.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/words/finding.hpp"

namespace triptych::report::words {
namespace {

using judge::Finding;

// "a, b are", or "a is" for one device.
std::string with_verb(const std::vector<std::string>& devices, std::string_view one,
                      std::string_view many) {
  return fmt::format("{} {}", fmt::join(devices, ", "), devices.size() == 1 ? one : many);
}

}  // namespace

std::string subject(const FindingGroup& group) {
  return group.configurations == 1 ? group.first->configuration
                                   : fmt::format("{} configurations", group.configurations);
}

std::string place(const Cause& cause) {
  const Finding& first = *cause.group.first;
  std::string text = first.device.empty() ? cause.result->plan : first.device;
  if (first.device.empty() && cause.plans > 1) {
    return fmt::format("{} and {} more", text, cause.plans - 1);
  }
  if (!cause.group.signature.empty()) text += ", " + cause.group.signature;
  if (cause.group.configurations > 1) text += fmt::format(" ({})", subject(cause.group));
  return text;
}

std::string found(const Cause& cause) {
  const FindingGroup& group = cause.group;
  std::string text = found(*group.first);
  if (!group.right_on.empty() && group.first->verdict == judge::Verdict::regression) {
    text += fmt::format("; {} right", with_verb(group.right_on, "is", "are"));
  }
  if (group.changed_with_it > 0) {
    text += group.configurations == 1
                ? "; its counters changed too"
                : fmt::format("; the counters of {} changed too", group.changed_with_it);
  }
  return text;
}

std::string blame(const FindingGroup& group) {
  const Blame blame = group.blame();
  switch (blame.of) {
    case Blame::Of::unknown:
      break;
    case Blame::Of::driver:
      return fmt::format("the driver is at fault: {} right by the same API",
                         with_verb(blame.devices, "is", "are"));
    case Blame::Of::driver_since_accepted:
      return fmt::format("the driver is at fault: {} right by the same API when accepted",
                         with_verb(blame.devices, "was", "were"));
    case Blame::Of::not_the_driver:
      return fmt::format("the driver is not at fault: {} wrong too",
                         with_verb(blame.devices, "is", "are"));
  }
  return {};
}

std::string text_of(const Cause& cause) {
  std::string text = found(cause);
  for (const std::string& more : {blame(cause.group), advice(*cause.group.first)}) {
    if (!more.empty()) text += "; " + more;
  }
  return text;
}

std::string_view word_of(core::ExitCode code) {
  switch (code) {
    case core::ExitCode::pass:
      return "PASS";
    case core::ExitCode::regression:
      return "FAIL";
    default:
      return "CANNOT JUDGE";
  }
}

std::string_view meaning_of(core::ExitCode code) {
  switch (code) {
    case core::ExitCode::pass:
      return "0: every requested check passed";
    case core::ExitCode::regression:
      return "1: something is wrong or has changed";
    default:
      return "2: something could not be judged, which does not count as a pass";
  }
}

}  // namespace triptych::report::words
