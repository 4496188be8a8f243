// Checks whether the run covers all devices that its machine should have, all configurations of its
// plan, and all checks that its baselines contain.

#include <algorithm>
#include <iterator>

#include "core/glob.hpp"
#include "core/quoting.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

bool applies(const AbsentDevice& entry, const record::Run& run, const std::string& today) {
  const bool expired = !entry.expiry.empty() && today >= entry.expiry;
  return !expired && std::ranges::any_of(run.begun, [&](const record::RunStart& begun) {
    return core::glob_matches(entry.host, begun.host);
  });
}

// Returns whether --without-device or absent.json declares that the device, or its whole API, is
// absent from this machine.
bool is_excused(const RunView& view, const std::string& device) {
  if (core::any_glob_matches(view.request.without_devices, device)) return true;
  return std::ranges::any_of(view.baselines.absent_devices(), [&](const AbsentDevice& entry) {
    return core::glob_matches(entry.device, device) && applies(entry, view.run, view.today());
  });
}

// Returns whether one of the run's commands would have measured the device if it had been present.
bool is_requested(const RunView& view, const std::string& device) {
  const bool judged =
      view.request.devices.empty() || core::any_glob_matches(view.request.devices, device);
  return judged && std::ranges::any_of(view.run.begun, [&](const record::RunStart& begun) {
           return begun.requests_device(device);
         });
}

AdviceWithCommand repair_advice(const std::string& device) {
  return {Advice::repair_driver, "--without-device " + core::shell_quoted(device)};
}

// Returns whether every requested device was named in full and found. In that case, a failed device
// enumeration cannot have hidden a requested device.
bool found_all_requested(const record::RunStart& begun) {
  return !begun.requested.empty() &&
         std::ranges::all_of(begun.requested, [&](const std::string& id) {
           return std::ranges::find(begun.found, id) != begun.found.end();
         });
}

// Reports each device enumeration that crashed or hung, because it may have missed devices.
void report_failed_listings(const RunView& view, std::vector<Finding>& findings) {
  for (const record::RunStart& begun : view.run.begun) {
    if (found_all_requested(begun)) continue;
    for (const record::Unusable& each : begun.unusable) {
      const std::string api = each.api();
      // If the device is required, report_required_devices() reports why it is missing.
      const bool required = std::ranges::find(view.request.required_devices, each.what) !=
                            view.request.required_devices.end();
      const bool matters = each.ended && begun.requests_api(api) && !required;
      if (!matters || is_excused(view, api) || is_excused(view, api + ":*")) continue;
      findings.push_back(finding_about(
          view, *view.checks.begin(), Verdict::cannot_judge,
          {.cause = Cause::listing_failed, .facts = {{"what", each.what}}, .reason = *each.ended},
          repair_advice(api)));
    }
  }
}

std::map<std::string, std::string> ids_of_drivers(const Manifest& manifest) {
  std::map<std::string, std::string> ids;
  for (const auto& [id, drivers] : manifest.devices) {
    for (const std::string& driver : drivers) ids.emplace(driver, id);
  }
  return ids;
}

// Returns whether a missing device must be reported. If a plan only compiles code, for GPUs that
// need not be present, a missing device is reported only if another device of the same driver was
// found, because the driver's compilers need not be installed on every machine. In the id of a
// device that only compiles, the part before the last '-' names the driver.
bool is_expected(const RunView& view, const std::string& id,
                 const std::vector<std::string>& found) {
  if (view.checks != std::set{Check::code}) return true;
  const std::string driver = id.substr(0, id.rfind('-') + 1);
  return !driver.empty() && std::ranges::any_of(found, [&](const std::string& other) {
    return other.starts_with(driver);
  });
}

// Returns the ids of accepted devices that were not found, although another device that was
// accepted on the same machine was found. Maps each id to the id of that other device.
std::map<std::string, std::string> missing_devices(const RunView& view) {
  const Manifest& manifest = view.baselines.manifest();
  const std::map<std::string, std::string> ids = ids_of_drivers(manifest);
  std::set<std::string> present_drivers;
  for (const auto& entry : view.store.devices(view.run.id)) {
    present_drivers.insert(entry.device.statistics_key());
  }
  const std::vector<std::string> found = record::found_in(view.run.begun);
  std::map<std::string, std::string> missing;
  for (const std::set<std::string>& machine : manifest.machines) {
    const auto known = std::ranges::find_if(
        machine, [&](const std::string& driver) { return present_drivers.contains(driver); });
    if (known == machine.end()) continue;
    for (const std::string& driver : machine) {
      const auto id = ids.find(driver);
      if (id == ids.end() || std::ranges::find(found, id->second) != found.end()) continue;
      if (!is_expected(view, id->second, found)) continue;
      const auto sibling = ids.find(*known);
      missing.emplace(id->second, sibling == ids.end() ? *known : sibling->second);
    }
  }
  return missing;
}

void report_missing_devices(const RunView& view, std::vector<Finding>& findings) {
  if (!view.baselines.present()) return;
  for (const auto& [id, sibling] : missing_devices(view)) {
    if (!is_requested(view, id) || is_excused(view, id)) continue;
    record::Device device;
    device.id = id;
    findings.push_back(finding_about(
        view, device, *view.checks.begin(), Verdict::cannot_judge,
        {.cause = Cause::device_missing, .facts = {{"sibling", sibling}}}, repair_advice(id)));
  }
}

// Reports devices that the run measured but does not describe. Such a device matches no stored key,
// so all other findings about it would only be advisory.
void report_undescribed_devices(const RunView& view, std::vector<Finding>& findings) {
  std::set<std::string> described;
  for (const auto& entry : view.store.devices(view.run.id)) described.insert(entry.device.id);
  std::set<std::string> measured;
  for (const record::Record* record : view.measured) measured.insert(record->device);
  std::vector<std::string> undescribed;
  std::ranges::set_difference(measured, described, std::back_inserter(undescribed));
  for (const std::string& id : undescribed) {
    findings.push_back(finding_about(
        view, view.devices.at(id), *view.checks.begin(), Verdict::cannot_judge,
        {.cause = Cause::no_description, .facts = {{"run", view.run.id}}}, {Advice::run_again}));
  }
}

// Reports checks that the baselines contain but the plan no longer requests. Otherwise, a plan
// could pass because somebody removed the check that would fail. Timing is left out unless times
// affect the verdict.
void report_lost_checks(const RunView& view, std::vector<Finding>& findings) {
  if (!view.baselines.present() || view.run.checks.empty()) return;
  std::vector<std::string> lost;
  for (const Check check : view.baselines.manifest().checks) {
    const bool decides = check != Check::timing || view.request.times_decide;
    if (decides && !view.run.checks.contains(check)) lost.emplace_back(name_of(check));
  }
  if (lost.empty()) return;
  findings.push_back(finding_about(view, *view.checks.begin(), Verdict::cannot_judge,
                                   {.cause = Cause::checks_lost, .names = lost},
                                   view.accept_advice()));
}

// Returns the first device that matches `glob` but was unusable in this run, or nullptr if there is
// none.
const record::Unusable* unusable_device(const RunView& view, const std::string& glob) {
  for (const record::RunStart& begun : view.run.begun) {
    for (const record::Unusable& each : begun.unusable) {
      if (core::glob_matches(glob, each.what)) return &each;
    }
  }
  return nullptr;
}

std::set<std::string> configurations_of(const RunView& view, const std::string& device) {
  std::set<std::string> recorded;
  for (const record::Record& record : view.records) {
    if (record.device == device) recorded.insert(record.configuration);
  }
  return recorded;
}

void report_missing(const RunView& view, const record::Device& device,
                    const std::set<std::string>& expected, const std::set<std::string>& recorded,
                    std::string_view kind, std::vector<Finding>& findings) {
  std::vector<std::string> missing;
  std::ranges::set_difference(expected, recorded, std::back_inserter(missing));
  if (missing.empty()) return;
  findings.push_back(finding_about(view, device, *view.checks.begin(), Verdict::cannot_judge,
                                   {.cause = Cause::missing,
                                    .numbers = {{"missing", static_cast<double>(missing.size())},
                                                {"wanted", static_cast<double>(expected.size())}},
                                    .names = missing,
                                    .facts = {{"kind", std::string(kind)}}},
                                   view.resume_advice()));
}

}  // namespace

void report_configurations(const RunView& view, std::vector<Finding>& findings) {
  const std::vector<std::string> planned =
      view.request.expected.empty() ? view.store.planned(view.run) : view.request.expected;
  const std::set<std::string> expected(planned.begin(), planned.end());
  std::set<std::string> accepted;
  if (view.baselines.present() && !view.request.part) {
    for (std::string& each : view.baselines.configurations()) accepted.insert(std::move(each));
  }
  for (const auto& [id, device] : view.devices) {
    const std::set<std::string> recorded = configurations_of(view, id);
    report_missing(view, device, expected, recorded, "planned", findings);
    std::set<std::string> covered = recorded;
    covered.insert(expected.begin(), expected.end());
    report_missing(view, device, accepted, covered, "accepted", findings);
    std::vector<std::string> extra;
    std::ranges::set_difference(recorded, expected, std::back_inserter(extra));
    if (expected.empty() || extra.empty()) continue;
    findings.push_back(finding_about(view, device, *view.checks.begin(), Verdict::cannot_judge,
                                     {.cause = Cause::extra, .names = extra}, {Advice::run_again}));
  }
}

std::map<std::string, TestedDevice> tested_devices(const RunView& view) {
  std::map<std::string, TestedDevice> tested;
  for (const auto& [id, device] : view.devices) {
    if (device.driver.empty() && device.driver_version.empty()) continue;
    tested[id] = {device.driver, device.driver_version,
                  !view.baselines.present() || view.knows_driver(device)};
  }
  return tested;
}

void report_required_devices(const RunView& view, std::vector<Finding>& findings) {
  for (const std::string& glob : view.request.required_devices) {
    const bool was_measured = std::ranges::any_of(view.measured, [&](const record::Record* record) {
      return core::glob_matches(glob, record->device);
    });
    if (was_measured) continue;
    Observation observation{.cause = Cause::no_required_device, .facts = {{"glob", glob}}};
    if (const record::Unusable* found = unusable_device(view, glob)) {
      observation.detail = found->reason;
      if (found->ended) observation.reason = *found->ended;
    }
    findings.push_back(
        finding_about(view, *view.checks.begin(), Verdict::cannot_judge, std::move(observation)));
  }
}

void report_incomplete_run(const RunView& view, std::vector<Finding>& findings) {
  report_lost_checks(view, findings);
  if (view.run.begun.empty()) return;
  report_undescribed_devices(view, findings);
  if (!view.request.decides_each_device) return;
  report_failed_listings(view, findings);
  report_missing_devices(view, findings);
}

}  // namespace triptych::judge
