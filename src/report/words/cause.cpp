#include "report/words/cause.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/quoting.hpp"
#include "record/short_name.hpp"
#include "report/words/finding.hpp"

namespace triptych::report::words {
namespace {

using judge::Finding;

// Returns "a, b are", or "a is" for a single device.
std::string with_verb(const std::vector<std::string>& devices, std::string_view one,
                      std::string_view many) {
  return fmt::format("{} {}", fmt::join(devices, ", "), devices.size() == 1 ? one : many);
}

}  // namespace

std::string subject(const FindingGroup& group) {
  return group.configurations == 1 ? record::short_name(group.first->configuration)
                                   : fmt::format("{} configurations", group.configurations);
}

std::string devices(const FindingGroup& group) {
  constexpr std::size_t most = 3;
  return group.devices.size() > most ? fmt::format("{} devices", group.devices.size())
                                     : fmt::format("{}", fmt::join(group.devices, ", "));
}

std::string location(const Cause& cause) {
  const Finding& first = *cause.group.first;
  std::string text = first.device.empty() ? cause.result->plan : devices(cause.group);
  if (first.device.empty() && cause.plans > 1) {
    return fmt::format("{} and {} more", text, cause.plans - 1);
  }
  if (!cause.group.signature.empty()) text += ", " + cause.group.signature;
  if (cause.group.configurations > 1) text += fmt::format(" ({})", subject(cause.group));
  return text;
}

std::string found(const Cause& cause) {
  const FindingGroup& group = cause.group;
  const Finding& worst = group.worst == nullptr ? *group.first : *group.worst;
  std::string text = found(worst);
  if (&worst != group.first) {
    const std::string where =
        group.devices.size() > 1 ? fmt::format(" on {}", worst.device) : std::string();
    text = fmt::format("worst in {}{}: {}", record::short_name(worst.configuration), where, text);
  }
  if (!group.correct_devices.empty() && group.first->verdict == judge::Verdict::regression) {
    text += fmt::format("; correct on {}", fmt::join(group.correct_devices, ", "));
  }
  if (group.changed_counters > 0) {
    text += group.configurations == 1
                ? "; the counters of this configuration changed, too"
                : fmt::format("; the counters of {} configurations changed, too",
                              group.changed_counters);
  }
  return text;
}

std::string attribution(const FindingGroup& group) {
  const FaultAttribution attribution = group.attribution();
  switch (attribution.kind) {
    case FaultAttribution::Kind::unknown:
      break;
    case FaultAttribution::Kind::driver:
      return fmt::format(
          "the driver is at fault, because {} correct",
          with_verb(attribution.devices, "uses the same API and is", "use the same API and are"));
    case FaultAttribution::Kind::driver_since_accepted:
      return fmt::format(
          "the driver is at fault, because {} correct when the baselines were accepted",
          with_verb(attribution.devices, "uses the same API and was", "use the same API and were"));
    case FaultAttribution::Kind::not_the_driver:
      return fmt::format("the driver is not at fault, because {} wrong, too",
                         with_verb(attribution.devices, "is", "are"));
  }
  return {};
}

std::string text_of(const Cause& cause) {
  std::string text = found(cause);
  for (const std::string& more : {attribution(cause.group), advice(*cause.group.first)}) {
    if (!more.empty()) text += "; " + more;
  }
  return text;
}

std::vector<std::string> next_steps(const Overview& all, std::string_view store_option) {
  const auto regression = [](const Cause& cause) {
    return cause.group.first->verdict == judge::Verdict::regression;
  };
  const auto against_stored = [&](const Cause& cause) {
    const judge::Against against = cause.group.first->against;
    return regression(cause) &&
           (against == judge::Against::baseline || against == judge::Against::other_devices);
  };
  if (std::ranges::none_of(all.open, regression)) return {};
  std::set<std::string> plans;
  for (const Cause& cause : all.open) {
    const judge::GateResult& result = *cause.result;
    if (against_stored(cause)) {
      plans.insert(core::shell_quoted(result.argument.empty() ? result.plan : result.argument));
    }
  }
  const bool drawn = std::ranges::any_of(all.open, [](const Cause& cause) {
    return command_of(*cause.group.first, *cause.result).find("triptych render ") !=
           std::string::npos;
  });
  std::string first = "next: see docs/gate.md";
  if (!plans.empty()) {
    first = fmt::format("next: to accept an intended change: triptych accept {}{} --reason TEXT",
                        fmt::join(plans, " "), store_option);
  } else if (drawn) {
    first = "next: for a bug report, replace `render` by `reduce` in the command above";
  }
  return {first, "      to find the commit: gate --bisect; to excuse a known bug: waivers.json"};
}

std::string_view verdict_word(core::ExitCode code) {
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
