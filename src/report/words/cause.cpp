#include "report/words/cause.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/quoting.hpp"
#include "record/short_name.hpp"
#include "report/finding_command.hpp"
#include "report/words/finding.hpp"

namespace triptych::report::words {
namespace {

using judge::Finding;

// Returns "a, b are", or "a is" for a single device.
std::string with_verb(const std::vector<std::string>& devices, std::string_view one,
                      std::string_view many) {
  return fmt::format("{} {}", fmt::join(devices, ", "), devices.size() == 1 ? one : many);
}

// Returns the plans in which values differ from stored values, as arguments of `triptych accept`:
// " volume/quick particles/quick".
std::string plans_with_changes(const Overview& all) {
  std::set<std::string> plans;
  for (const Cause& cause : all.open) {
    const Finding& first = *cause.group.first;
    const bool stored =
        first.against == judge::Against::baseline || first.against == judge::Against::other_devices;
    if (first.verdict != judge::Verdict::regression || !stored) continue;
    const judge::GateResult& result = *cause.result;
    plans.insert(core::shell_quoted(result.argument.empty() ? result.plan : result.argument));
  }
  std::string text;
  for (const std::string& plan : plans) text += " " + plan;
  return text;
}

// Returns the name of the file to which the user can add a waiver.
std::string waivers_file(const Overview& all) {
  const std::string& file = all.open.front().result->waivers_file;
  return file.empty() ? "baselines/waivers.json" : core::shell_quoted(file);
}

// Lists checks with the devices on which they reached no verdict: "statistics on gl:x; timing". The
// devices are left out if the check reached no verdict on any device.
std::string undecided_text(const Overview& all) {
  constexpr std::size_t most = 3;
  std::string text;
  for (const auto& [check, devices] : all.undecided) {
    text += fmt::format("{}{}", text.empty() ? "" : "; ", judge::name_of(check));
    if (devices.size() > most) {
      text += fmt::format(" on {} devices", devices.size());
    } else if (!devices.empty()) {
      text += fmt::format(" on {}", fmt::join(devices, ", "));
    }
  }
  return text;
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
    case FaultAttribution::Kind::driver_version:
      return "the driver is at fault, because another version of it was correct when the baselines "
             "were accepted";
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

std::string waived_text(const Cause& cause) {
  const FindingGroup& group = cause.group;
  const Finding& worst = group.worst == nullptr ? *group.first : *group.worst;
  return fmt::format("{}{}: {}", excuse(worst), location(cause),
                     text_of(static_cast<const judge::Observation&>(worst)));
}

std::vector<std::string> next_steps(const Overview& all, std::string_view store_option) {
  const auto regression = [](const Cause& cause) {
    return cause.group.first->verdict == judge::Verdict::regression;
  };
  if (std::ranges::none_of(all.open, regression)) return {};
  const bool injected = std::ranges::any_of(
      all.open, [](const Cause& cause) { return !cause.result->injected.empty(); });
  std::vector<std::string> steps;
  // Accepting a run cannot correct an image, and would also accept its wrong images, so it is not
  // suggested if any frame is wrong.
  if (std::ranges::any_of(all.open, [&](const Cause& cause) {
        return regression(cause) && is_reproduced_by_render(*cause.group.first);
      })) {
    steps.emplace_back("for a bug report, replace `render` by `reduce` in the command above");
  } else if (const std::string plans = plans_with_changes(all); !plans.empty() && !injected) {
    steps.push_back(fmt::format("to accept an intended change: triptych accept{}{} --reason TEXT",
                                plans, store_option));
  }
  if (injected) {
    steps.emplace_back("to test the driver, measure again without --inject");
  } else {
    steps.emplace_back("to find the commit: gate --bisect (docs/gate.md)");
    steps.push_back(fmt::format("to excuse a known bug: {} (docs/validate.md)", waivers_file(all)));
  }
  for (std::string& each : steps) {
    each.insert(0, &each == steps.data() ? "next: " : "      ");
  }
  return steps;
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

std::string pass_text(const Overview& all) {
  if (all.undecided.empty()) return "every requested check passed";
  return fmt::format("every check that reached a verdict passed; no verdict: {}",
                     undecided_text(all));
}

std::string meaning_of(const Overview& all) {
  switch (all.code) {
    case core::ExitCode::pass:
      return "0: " + pass_text(all);
    case core::ExitCode::regression:
      return "1: something is wrong or has changed";
    default:
      return "2: something could not be judged, which does not count as a pass";
  }
}

}  // namespace triptych::report::words
