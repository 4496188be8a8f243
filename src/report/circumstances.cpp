#include "report/circumstances.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "report/words/finding.hpp"
#include "report/words/outcome.hpp"

namespace triptych::report {

namespace {

// Reports results that were skipped because data files are missing. Names only one of the files,
// because the others are usually in the same folder.
std::string absent_data(std::span<const judge::GateResult* const> results) {
  std::set<std::string> files;
  std::set<std::tuple<std::string, std::string, std::string>> missing;
  bool excused = true;
  for (const judge::GateResult* result : results) {
    for (const judge::Finding& finding : result->findings) {
      if (!record::lacks_data(finding.outcome, finding.reason)) continue;
      files.insert(finding.reason.subject);
      missing.emplace(result->plan, finding.device, finding.configuration);
      excused = excused && result->data_excused;
    }
  }
  if (files.empty()) return {};
  return fmt::format(
      "missing data files: {} ({}{}), so {} results were skipped; docs/data.md lists where to "
      "download the files{}",
      files.size(), *files.begin(), files.size() > 1 ? ", …" : "", missing.size(),
      excused ? "" : "; if this machine does not need them, use --without-data");
}

// Returns a line for each waiver that has no effect.
std::set<std::string> ineffective_waivers(std::span<const judge::GateResult* const> results) {
  std::set<std::string> lines;
  for (const judge::GateResult* result : results) {
    for (const judge::Finding& finding : result->findings) {
      if (judge::is_about_waiver(finding)) lines.insert(words::text_of(finding));
    }
  }
  return lines;
}

// Returns a line about the baselines, if they are not in the working directory's own folder.
std::string other_baselines(std::span<const judge::GateResult* const> results) {
  std::set<std::string> folders;
  bool fallback = false;
  for (const judge::GateResult* result : results) {
    if (result->other_baselines.empty()) continue;
    folders.insert(result->other_baselines);
    fallback = fallback || result->lacks_own_baselines;
  }
  if (folders.empty()) return {};
  return fmt::format("compared with the baselines in {}{}", fmt::join(folders, ", "),
                     fallback ? ", because the working directory has no folder `baselines`" : "");
}

// Returns a line about the devices whose driver versions were never accepted. If a version was
// accepted for some of the judged plans, also names the plans for which it was not.
std::string unaccepted_drivers(std::span<const judge::GateResult* const> results) {
  std::map<std::string, std::set<std::string>> plans_of_device;
  std::set<std::string> accepted_somewhere;
  std::map<std::string, std::string> drivers;
  for (const judge::GateResult* result : results) {
    for (const auto& [id, device] : result->tested) {
      drivers[id] = words::driver_text(device);
      if (device.accepted) {
        accepted_somewhere.insert(id);
      } else {
        plans_of_device[id].insert(result->plan);
      }
    }
  }
  std::map<std::string, std::vector<std::string>> devices_of_driver;
  for (const auto& [id, plans] : plans_of_device) {
    std::string driver = drivers[id];
    if (accepted_somewhere.contains(id)) driver += fmt::format(" in {}", fmt::join(plans, ", "));
    devices_of_driver[driver].push_back(id);
  }
  if (devices_of_driver.empty()) return {};
  std::vector<std::string> parts;
  for (const auto& [driver, devices] : devices_of_driver) {
    parts.push_back(fmt::format("{} ({})", driver, fmt::join(devices, ", ")));
  }
  return fmt::format("driver versions that are not among the accepted ones: {}",
                     fmt::join(parts, "; "));
}

}  // namespace

std::vector<std::string> circumstances(std::span<const judge::GateResult* const> results) {
  std::set<std::string> injected;
  std::size_t injected_records = 0;
  // Unusable loaders and drivers, by reason.
  std::map<std::string, std::set<std::string>> unusable;
  std::set<std::string> programs;
  std::set<std::string> days;
  for (const judge::GateResult* result : results) {
    for (const auto& [fault, records] : result->injected) {
      injected.insert(fault);
      injected_records += records;
    }
    for (const record::Unusable& each : result->unusable) {
      unusable[each.ended ? words::text_of(*each.ended) : each.reason].insert(each.what);
    }
    if (!result->measured_by.empty()) programs.insert(result->measured_by);
    if (!result->old_run_date.empty()) days.insert(result->old_run_date);
  }
  std::vector<std::string> lines;
  if (!injected.empty()) {
    lines.push_back(fmt::format(
        "this verdict tests only Triptych, because {} record{} injected faults ({})",
        injected_records, injected_records == 1 ? " has" : "s have", fmt::join(injected, ", ")));
  }
  for (std::string line : {other_baselines(results), unaccepted_drivers(results)}) {
    if (!line.empty()) lines.push_back(std::move(line));
  }
  for (const std::string& program : programs) {
    lines.push_back(fmt::format("measured by another build of Triptych: {}", program));
  }
  if (!days.empty()) {
    lines.push_back(
        fmt::format("the measurements are from {}, because the store has no newer run of the plan",
                    fmt::join(days, " and ")));
  }
  for (const auto& [reason, what] : unusable) {
    lines.push_back(fmt::format("unusable on this machine: {}: {}", fmt::join(what, ", "), reason));
  }
  if (std::string data = absent_data(results); !data.empty()) lines.push_back(std::move(data));
  for (const std::string& waiver : ineffective_waivers(results)) lines.push_back(waiver);
  return lines;
}

}  // namespace triptych::report
