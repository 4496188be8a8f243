#include <algorithm>
#include <cmath>
#include <set>

#include "judge/correlation/line.hpp"
#include "judge/gate/cost_by_device.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

const record::Record& any_record(const DeviceCost& device) {
  return *device.configurations.begin()->second.record;
}

Finding about_device(const DeviceCost& device, Verdict verdict, Observation observation) {
  Finding finding =
      finding_about(any_record(device), Check::correlation, verdict, std::move(observation));
  finding.configuration.clear();
  return finding;
}

// --- Accepted devices: their residuals are compared with the stored residuals --------------------

// The residual of two devices for a configuration is the logarithm of the ratio of their costs
// (judge/correlation/residuals.hpp).

// The configurations of one device that were also measured on at least one other device, and how
// much the cost of each configuration changed.
struct DeviceMovement {
  const DeviceCost* device = nullptr;
  std::vector<const record::Record*> records;
  std::vector<double> log_changes;  // change in ln cost of each record; 0 if no residual changed
  std::set<std::string> compared_with;  // names of the devices with which this device was compared
  std::set<std::string> moved_against;  // names of the devices whose residual with it changed
};

Repeatability repeatability_of(const ConfigurationCost& cost) {
  return repeatability(cost.record->device, cost.record->technique, *cost.stored);
}

CostChange change_of(const ConfigurationCost& cost) {
  return change_of(*cost.stored, cost.now);
}

// Returns the accepted devices whose instructions were counted by the same emulator as those of
// `device`: the devices in the run or, if there are none, the devices that only the baselines
// contain.
std::vector<const DeviceCost*> partners_of(const DeviceCost& device,
                                           const std::vector<DeviceCost>& devices) {
  std::vector<const DeviceCost*> measured;
  std::vector<const DeviceCost*> stored;
  for (const DeviceCost& other : devices) {
    if (&other == &device || other.counted_by != device.counted_by || !other.accepted()) continue;
    (other.measured ? measured : stored).push_back(&other);
  }
  return measured.empty() ? stored : measured;
}

// Returns whether the ratio of the costs of two devices differs from the stored ratio by more than
// the repeatability of the counts. For a device that is not in the run, the stored cost itself
// is used, so its repeatability is 0.
bool residual_changed(const ConfigurationCost& own, const ConfigurationCost& other) {
  const Repeatability none{0, 0};
  return residual_moved(change_of(other), other.record ? repeatability_of(other) : none,
                        change_of(own), repeatability_of(own));
}

// Finds the configurations whose cost on this device changed since it was accepted, although their
// cost on another device did not change by the same factor.
DeviceMovement movement_of(const DeviceCost& device, const std::vector<DeviceCost>& devices) {
  DeviceMovement moved{&device, {}, {}, {}, {}};
  const std::vector<const DeviceCost*> partners = partners_of(device, devices);
  for (const auto& [configuration, own] : device.configurations) {
    if (!own.stored) continue;
    const double change = significant_change(change_of(own), repeatability_of(own));
    double reported_change = 0;
    bool has_partner = false;
    for (const DeviceCost* other : partners) {
      const auto other_cost = other->configurations.find(configuration);
      if (other_cost == other->configurations.end() || !other_cost->second.stored) continue;
      has_partner = true;
      moved.compared_with.insert(other->name);
      if (change == 0 || !residual_changed(own, other_cost->second)) continue;
      reported_change = change;
      moved.moved_against.insert(other->name);
    }
    if (!has_partner) continue;
    moved.records.push_back(own.record);
    moved.log_changes.push_back(reported_change);
  }
  return moved;
}

Finding finding_of(const DeviceMovement& moved, const Movement& movement) {
  const bool more = movement.log_ratio > 0;
  const record::Record& first = *moved.records[movement.members.front()];
  Finding finding =
      finding_about(first, Check::correlation, more ? Verdict::regression : Verdict::improved,
                    {.cause = Cause::residual_moved,
                     .against = Against::other_devices,
                     .names = {moved.moved_against.begin(), moved.moved_against.end()}});
  if (movement.scope != Movement::Scope::configuration) {
    finding.configuration.clear();
    finding.subject = movement.scope == Movement::Scope::level ? movement.level : "everything";
  }
  set_number(finding, "ratio", std::exp(movement.log_ratio));
  set_number(finding, "least_ratio", std::exp(movement.least));
  set_number(finding, "largest_ratio", std::exp(movement.most));
  set_number(finding, "configurations", static_cast<double>(movement.members.size()));
  return finding;
}

void judge_accepted(const DeviceMovement& moved, std::vector<Finding>& findings) {
  std::vector<Factors> factors;
  for (const record::Record* record : moved.records) factors.push_back(factors_of(*record));
  const std::vector<Movement> movements = explain(moved.log_changes, factors);
  for (const Movement& movement : movements) findings.push_back(finding_of(moved, movement));
  if (!movements.empty()) return;
  findings.push_back(
      about_device(*moved.device, Verdict::pass,
                   {.cause = Cause::residuals_as_stored,
                    .against = Against::other_devices,
                    .numbers = {{"configurations", static_cast<double>(moved.records.size())}},
                    .names = {moved.compared_with.begin(), moved.compared_with.end()}}));
}

// --- New devices: their costs are compared with the predictions of a fitted line -----------------

void add_fit(Observation& observation, const CorrelationLine& line) {
  set_number(observation, "configurations", static_cast<double>(line.configurations));
  set_number(observation, "intercept", line.intercept);
  set_number(observation, "slope", line.slope);
  set_number(observation, "scale", line.scale);
  set_number(observation, "rho", line.rho);
  set_number(observation, "pearson", line.pearson);
}

// Returns the pair of the new device and the accepted device that predicts its costs best: the pair
// with the least scatter about its line. A pair whose line was refused is used only if no pair has
// an accepted line. Returns nullptr if there is no pair.
const CorrelationPair* best_pair(const DeviceCost& device,
                                 const std::vector<CorrelationPair>& pairs) {
  const CorrelationPair* best = nullptr;
  const auto is_better = [](const CorrelationPair& a, const CorrelationPair& b) {
    if (a.line.admitted() != b.line.admitted()) return a.line.admitted();
    return a.line.scale < b.line.scale;
  };
  for (const CorrelationPair& pair : pairs) {
    if (!pair.new_device || pair.device_b != device.name) continue;
    if (best == nullptr || is_better(pair, *best)) best = &pair;
  }
  return best;
}

Finding finding_of(const DeviceCost& device, const CorrelationPair& pair,
                   const LineOutlier& outlier) {
  Finding finding = about_device(device, Verdict::advisory,
                                 {.cause = Cause::off_the_line,
                                  .against = Against::other_devices,
                                  .facts = {{"other", pair.device_a}}});
  if (outlier.level.empty()) {
    finding.configuration = pair.points[outlier.members.front()].configuration;
  } else {
    finding.subject = outlier.level;
  }
  set_number(finding, "configurations", static_cast<double>(outlier.members.size()));
  set_number(finding, "ratio", std::exp(outlier.effect));
  set_number(finding, "standard_error", outlier.error);
  set_number(finding, "q", outlier.q);
  set_number(finding, "scale", pair.line.scale);
  return finding;
}

std::vector<LineOutlier> line_outliers_of(const DeviceCost& device, const CorrelationPair& pair) {
  std::vector<Factors> factors;
  for (const CorrelationPoint& point : pair.points) {
    factors.push_back(factors_of(*device.configurations.at(point.configuration).record));
  }
  return line_outliers(pair.points, factors);
}

void judge_new(const DeviceCost& device, std::vector<CorrelationPair>& pairs,
               std::vector<Finding>& findings) {
  const CorrelationPair* best = best_pair(device, pairs);
  if (best == nullptr || !best->line.admitted()) {
    Observation observation{.cause = Cause::no_partner,
                            .facts = {{"counted_by", device.counted_by}}};
    if (best != nullptr) {
      observation = {.cause = Cause::no_line,
                     .facts = {{"other", best->device_a},
                               {"refusal", std::string(name_of(best->line.refusal))}}};
      add_fit(observation, best->line);
    }
    findings.push_back(about_device(device, Verdict::advisory, std::move(observation)));
    return;
  }
  CorrelationPair& pair = pairs[static_cast<std::size_t>(best - pairs.data())];
  const std::vector<LineOutlier> all = line_outliers_of(device, pair);
  for (const LineOutlier& outlier : all) {
    findings.push_back(finding_of(device, pair, outlier));
    if (outlier.level.empty()) pair.points[outlier.members.front()].outlier = true;
  }
  if (!all.empty()) return;
  Observation observation{.cause = Cause::on_the_line,
                          .against = Against::other_devices,
                          .facts = {{"other", pair.device_a}}};
  add_fit(observation, pair.line);
  findings.push_back(about_device(device, Verdict::advisory, std::move(observation)));
}

// --- Pairs of devices ----------------------------------------------------------------------------

// Returns all pairs of devices in the run, and the pairs of a new device and an accepted device
// that is not in the run. Pairs of two new devices are shown but not judged.
std::vector<CorrelationPair> pairs_by_cost(const std::vector<DeviceCost>& devices) {
  std::vector<CorrelationPair> pairs;
  for (std::size_t a = 0; a < devices.size(); ++a) {
    for (std::size_t b = a + 1; b < devices.size(); ++b) {
      if (devices[a].counted_by != devices[b].counted_by) continue;
      const bool only_b_is_accepted = devices[b].accepted() && !devices[a].accepted();
      if (!devices[a].measured) continue;  // b was not measured either: measured devices come first
      // A device that is not in the run is paired only with a new device.
      if (!devices[b].measured && !only_b_is_accepted) continue;
      pairs.push_back(only_b_is_accepted ? pair_of(devices[b], devices[a])
                                         : pair_of(devices[a], devices[b]));
    }
  }
  return pairs;
}

void mark_outliers(const DeviceMovement& moved, std::vector<CorrelationPair>& pairs) {
  std::set<std::string_view> outliers;
  for (std::size_t i = 0; i < moved.records.size(); ++i) {
    if (moved.log_changes[i] != 0) outliers.insert(moved.records[i]->configuration);
  }
  for (CorrelationPair& pair : pairs) {
    const bool first = pair.device_a == moved.device->name;
    if (!first && pair.device_b != moved.device->name) continue;
    if (!moved.moved_against.contains(first ? pair.device_b : pair.device_a)) continue;
    for (CorrelationPoint& point : pair.points) {
      point.outlier = point.outlier || outliers.contains(point.configuration);
    }
  }
}

// Adds a finding for each device of the run whose instructions were not counted.
void report_uncounted(const CorrelationInput& input, const std::vector<DeviceCost>& devices,
                      std::vector<Finding>& findings) {
  std::set<std::string> counted_devices;
  for (const DeviceCost& device : devices) {
    if (device.measured) counted_devices.insert(device.id);
  }
  for (const record::Record* record : input.records) {
    if (!counted_devices.insert(record->device).second) continue;
    findings.push_back(finding_about(*record, Check::correlation, Verdict::skipped,
                                     {.cause = Cause::not_reported}));
    findings.back().configuration.clear();
  }
}

}  // namespace

CorrelationFindings correlate(const CorrelationInput& input) {
  CorrelationFindings result;
  const std::vector<DeviceCost> devices = cost_by_device(input);
  result.pairs = pairs_by_cost(devices);
  for (const DeviceCost& device : devices) {
    if (!device.measured) continue;
    const DeviceMovement moved = movement_of(device, devices);
    if (moved.compared_with.empty()) {
      judge_new(device, result.pairs, result.findings);
    } else {
      judge_accepted(moved, result.findings);
      mark_outliers(moved, result.pairs);
    }
  }
  report_uncounted(input, devices, result.findings);
  std::ranges::move(pairs_by_time(input), std::back_inserter(result.pairs));
  return result;
}

CorrelationFindings check_correlations(const RunView& view, const WrongImages& wrong) {
  CorrelationInput input{view.devices, {}, view.baselines.cost_of_all_drivers()};
  for (const record::Record* record : view.measured) {
    if (!wrong.contains({record->device, record->configuration})) input.records.push_back(record);
  }
  return correlate(input);
}

}  // namespace triptych::judge
