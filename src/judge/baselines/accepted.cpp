#include "judge/baselines/accepted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/error.hpp"
#include "core/glob.hpp"
#include "core/quoting.hpp"

namespace triptych::judge {
namespace {

void refuse_unsuitable(const std::vector<record::Record>& records, const std::string& run,
                       const AcceptRequest& request) {
  if (request.reason.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw core::InputError("`accept` needs a reason (--reason TEXT)");
  }
  for (const record::Record& record : records) {
    if (record.plan != request.plan) {
      throw core::InputError(
          fmt::format("run {} is a run of plan {}, not of {}", run, record.plan, request.plan));
    }
    if (!record.injected.empty()) {
      throw core::InputError(fmt::format(
          "run {} contains the injected fault '{}' ({} on {}), so it cannot become a baseline", run,
          record.injected, record.configuration, record.device));
    }
  }
}

std::string quoted_plan_argument(const AcceptRequest& request) {
  return core::shell_quoted(request.argument.empty() ? record::plan_argument(request.plan)
                                                     : request.argument);
}

// Returns the devices on which something was measured. Only these devices become part of the
// baselines.
std::set<std::string> devices_with_measurements(const std::vector<record::Record>& records) {
  std::set<std::string> devices;
  for (const record::Record& record : records) {
    if (record.outcome == record::Outcome::measured) devices.insert(record.device);
  }
  return devices;
}

bool lacks_support(const record::Record& record) {
  return record.outcome == record::Outcome::skipped &&
         record.reason.cause == record::Cause::not_supported;
}

}  // namespace

Accepted select_accepted(const record::Store& store, const std::string& run,
                         const AcceptRequest& request) {
  const std::vector<record::Record> records = store.records(run);
  refuse_unsuitable(records, run, request);
  Accepted accepted;
  for (record::Run& each : store.runs()) {
    if (each.id == run) accepted.run = std::move(each);
  }
  accepted.checks = checks_of_run(accepted.run);
  accepted.replaces_all = request.only.empty();
  const std::set<std::string> with_measurements = devices_with_measurements(records);
  for (const record::Record& record : records) {
    accepted.configurations.insert(record.configuration);
    accepted.scenes.insert(record.scene);
    const bool selected =
        request.only.empty() || core::glob_matches(request.only, record.configuration);
    if (selected && record.outcome == record::Outcome::measured) {
      accepted.measured.push_back(record);
    }
    const bool drops_skipped = request.drop && !request.only.empty();
    if (selected && drops_skipped && record.outcome == record::Outcome::skipped) {
      accepted.skipped.push_back(record);
    }
    if (selected && lacks_support(record) && with_measurements.contains(record.device)) {
      accepted.unsupported.push_back(record);
    }
  }
  if (accepted.measured.empty() && accepted.skipped.empty() && accepted.unsupported.empty()) {
    throw core::InputError(
        fmt::format("run {}: nothing was measured{}", run,
                    request.only.empty() ? "" : " that matches " + request.only));
  }
  std::set<std::string> accepted_devices;
  for (const record::Record& record : accepted.measured) accepted_devices.insert(record.device);
  for (const record::Record& record : accepted.skipped) accepted_devices.insert(record.device);
  for (const record::Record& record : accepted.unsupported) accepted_devices.insert(record.device);
  for (const auto& entry : store.devices(run)) {
    if (accepted_devices.contains(entry.device.id)) {
      accepted.devices.emplace(entry.device.id, entry.device);
    }
  }
  return accepted;
}

void refuse_other_data(const Accepted& accepted, const AcceptRequest& request) {
  if (!request.data_hash) return;
  for (const record::Record& record : accepted.measured) {
    if (record.data_hash.empty()) continue;
    const std::string current_hash = request.data_hash(record);
    if (current_hash.empty() || current_hash == record.data_hash) continue;
    throw core::InputError(fmt::format(
        "the input data of {} have changed since run {} (content hash {}, now {}); restore the "
        "data, or measure again",
        record.configuration, record.run, record.data_hash, current_hash));
  }
}

void refuse_part(const Accepted& accepted, const Baselines& stored, const std::string& run,
                 const AcceptRequest& request) {
  if (!accepted.replaces_all || request.drop) return;
  const std::vector<std::string> known = stored.configurations();
  std::vector<std::string> missing;
  std::ranges::set_difference(known, accepted.configurations, std::back_inserter(missing));
  if (missing.empty()) return;
  throw core::InputError(fmt::format(
      "run {} has no records for {} of the {} stored configurations ({}{}); finish the run with "
      "triptych run {} --resume{}, accept some configurations with --only GLOB, or use --drop if "
      "the plan no longer contains the missing configurations",
      run, missing.size(), known.size(), missing.front(), missing.size() > 1 ? "; …" : "",
      quoted_plan_argument(request), request.store_option));
}

void refuse_incomplete(const record::Store& store, const Accepted& accepted,
                       const AcceptRequest& request) {
  if (!accepted.replaces_all || request.drop) return;
  const std::vector<std::string> planned = store.planned(accepted.run);
  for (const std::string& device : record::devices_of(accepted.run.begun)) {
    const std::set<std::string> recorded = store.configurations(accepted.run.id, device);
    std::vector<std::string> missing;
    std::ranges::set_difference(planned, recorded, std::back_inserter(missing));
    if (missing.empty()) continue;
    throw core::InputError(fmt::format(
        "run {} is incomplete: of the {} configurations on {}, {} have no record ({}{}); finish "
        "the run with triptych run {} --resume{}, or accept the measured configurations with "
        "--only GLOB or --drop",
        accepted.run.id, planned.size(), device, missing.size(), missing.front(),
        missing.size() > 1 ? "; …" : "", quoted_plan_argument(request), request.store_option));
  }
}

record::Checks checks_of_run(const record::Run& run) {
  if (!run.checks.empty()) return run.checks;
  return {record::Check::image, record::Check::counters, record::Check::statistics,
          record::Check::cost,  record::Check::memory,   record::Check::timing};
}

}  // namespace triptych::judge
