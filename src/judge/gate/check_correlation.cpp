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

Finding about_device(const DeviceCost& device, Verdict verdict, Observation what) {
  Finding finding = finding_about(any_record(device), Check::correlation, verdict, std::move(what));
  finding.configuration.clear();
  return finding;
}

// --- Accepted devices: their residuals are compared with the stored residuals --------------------

// The residual of two devices for a configuration is the logarithm of the ratio of their costs
// (judge/correlation/residuals.hpp).

// The configurations of one device that were also measured on at least one other device, and how
// much the cost of each configuration changed.
struct Moved {
  const DeviceCost* device = nullptr;
  std::vector<const record::Record*> records;
  std::vector<double> by;        // change in ln cost of each record; 0 if no residual changed
  std::set<std::string> held;    // names of the devices with which this device was compared
  std::set<std::string> beside;  // names of the devices whose residual with this device changed
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
  std::vector<const DeviceCost*> here;
  std::vector<const DeviceCost*> stored;
  for (const DeviceCost& other : devices) {
    if (&other == &device || other.counted_by != device.counted_by || !other.accepted()) continue;
    (other.measured ? here : stored).push_back(&other);
  }
  return here.empty() ? stored : here;
}

// Returns whether the ratio of the costs of two devices differs from the stored ratio by more than
// the repeatability of the counts. For a device that is not in the run, the stored cost itself
// is used, so its repeatability is 0.
bool left_residual(const ConfigurationCost& own, const ConfigurationCost& other) {
  const Repeatability none{0, 0};
  return residual_moved(change_of(other), other.record ? repeatability_of(other) : none,
                        change_of(own), repeatability_of(own));
}

// Finds the configurations whose cost on this device changed since it was accepted, although their
// cost on another device did not change by the same factor.
Moved movements_of(const DeviceCost& device, const std::vector<DeviceCost>& devices) {
  Moved moved{&device, {}, {}, {}, {}};
  const std::vector<const DeviceCost*> partners = partners_of(device, devices);
  for (const auto& [configuration, own] : device.configurations) {
    if (!own.stored) continue;
    const double change = moved_by(change_of(own), repeatability_of(own));
    double shown = 0;
    bool common = false;
    for (const DeviceCost* other : partners) {
      const auto there = other->configurations.find(configuration);
      if (there == other->configurations.end() || !there->second.stored) continue;
      common = true;
      moved.held.insert(other->name);
      if (change == 0 || !left_residual(own, there->second)) continue;
      shown = change;
      moved.beside.insert(other->name);
    }
    if (!common) continue;
    moved.records.push_back(own.record);
    moved.by.push_back(shown);
  }
  return moved;
}

Finding finding_of(const Moved& moved, const Movement& movement) {
  const bool more = movement.log_ratio > 0;
  const record::Record& first = *moved.records[movement.members.front()];
  Finding finding =
      finding_about(first, Check::correlation, more ? Verdict::regression : Verdict::improved,
                    {.cause = Cause::residual_moved,
                     .against = Against::other_devices,
                     .names = {moved.beside.begin(), moved.beside.end()}});
  if (movement.of != Movement::Of::configuration) {
    finding.configuration.clear();
    finding.subject = movement.of == Movement::Of::level ? movement.level : "everything";
  }
  set_number(finding, "ratio", std::exp(movement.log_ratio));
  set_number(finding, "least_ratio", std::exp(movement.least));
  set_number(finding, "largest_ratio", std::exp(movement.most));
  set_number(finding, "configurations", static_cast<double>(movement.members.size()));
  return finding;
}

void judge_accepted(const Moved& moved, std::vector<Finding>& findings) {
  std::vector<Factors> factors;
  for (const record::Record* record : moved.records) factors.push_back(factors_of(*record));
  const std::vector<Movement> movements = explain(moved.by, factors);
  for (const Movement& movement : movements) findings.push_back(finding_of(moved, movement));
  if (!movements.empty()) return;
  findings.push_back(
      about_device(*moved.device, Verdict::pass,
                   {.cause = Cause::residuals_as_stored,
                    .against = Against::other_devices,
                    .numbers = {{"configurations", static_cast<double>(moved.records.size())}},
                    .names = {moved.held.begin(), moved.held.end()}}));
}

// --- New devices: their costs are compared with the predictions of a fitted line -----------------

void add_fit(Observation& what, const CorrelationLine& line) {
  set_number(what, "configurations", static_cast<double>(line.configurations));
  set_number(what, "intercept", line.intercept);
  set_number(what, "slope", line.slope);
  set_number(what, "scale", line.scale);
  set_number(what, "rho", line.rho);
  set_number(what, "pearson", line.pearson);
}

// Returns the pair of the new device and the accepted device that predicts its costs best: the pair
// with the least scatter about its line. A pair whose line was refused is used only if no pair has
// an accepted line. Returns nullptr if there is no pair.
const CorrelationPair* nearest(const DeviceCost& device,
                               const std::vector<CorrelationPair>& pairs) {
  const CorrelationPair* best = nullptr;
  const auto is_nearer = [](const CorrelationPair& a, const CorrelationPair& b) {
    if (a.line.admitted() != b.line.admitted()) return a.line.admitted();
    return a.line.scale < b.line.scale;
  };
  for (const CorrelationPair& pair : pairs) {
    if (!pair.new_device || pair.device_b != device.name) continue;
    if (best == nullptr || is_nearer(pair, *best)) best = &pair;
  }
  return best;
}

Finding finding_of(const DeviceCost& device, const CorrelationPair& pair, const OffTheLine& off) {
  Finding finding = about_device(device, Verdict::advisory,
                                 {.cause = Cause::off_the_line,
                                  .against = Against::other_devices,
                                  .facts = {{"other", pair.device_a}}});
  if (off.level.empty()) {
    finding.configuration = pair.points[off.members.front()].configuration;
  } else {
    finding.subject = off.level;
  }
  set_number(finding, "configurations", static_cast<double>(off.members.size()));
  set_number(finding, "ratio", std::exp(off.effect));
  set_number(finding, "standard_error", off.error);
  set_number(finding, "q", off.q);
  set_number(finding, "scale", pair.line.scale);
  return finding;
}

std::vector<OffTheLine> off_the_line_of(const DeviceCost& device, const CorrelationPair& pair) {
  std::vector<Factors> factors;
  for (const CorrelationPoint& point : pair.points) {
    factors.push_back(factors_of(*device.configurations.at(point.configuration).record));
  }
  return off_the_line(pair.points, factors);
}

void judge_new(const DeviceCost& device, std::vector<CorrelationPair>& pairs,
               std::vector<Finding>& findings) {
  const CorrelationPair* found = nearest(device, pairs);
  if (found == nullptr || !found->line.admitted()) {
    Observation what{.cause = Cause::no_partner, .facts = {{"counted_by", device.counted_by}}};
    if (found != nullptr) {
      what = {.cause = Cause::no_line,
              .facts = {{"other", found->device_a},
                        {"refusal", std::string(name_of(found->line.refusal))}}};
      add_fit(what, found->line);
    }
    findings.push_back(about_device(device, Verdict::advisory, std::move(what)));
    return;
  }
  CorrelationPair& pair = pairs[static_cast<std::size_t>(found - pairs.data())];
  const std::vector<OffTheLine> all = off_the_line_of(device, pair);
  for (const OffTheLine& off : all) {
    findings.push_back(finding_of(device, pair, off));
    if (off.level.empty()) pair.points[off.members.front()].outlier = true;
  }
  if (!all.empty()) return;
  Observation what{.cause = Cause::on_the_line,
                   .against = Against::other_devices,
                   .facts = {{"other", pair.device_a}}};
  add_fit(what, pair.line);
  findings.push_back(about_device(device, Verdict::advisory, std::move(what)));
}

// --- Pairs of devices ----------------------------------------------------------------------------

// Returns all pairs of devices in the run, and the pairs of a new device and an accepted device
// that is not in the run. Pairs of two new devices are shown but not judged.
std::vector<CorrelationPair> pairs_by_cost(const std::vector<DeviceCost>& devices) {
  std::vector<CorrelationPair> pairs;
  for (std::size_t a = 0; a < devices.size(); ++a) {
    for (std::size_t b = a + 1; b < devices.size(); ++b) {
      if (devices[a].counted_by != devices[b].counted_by) continue;
      const bool b_is_known = devices[b].accepted() && !devices[a].accepted();
      if (!devices[a].measured) continue;  // b was not measured either: measured devices come first
      // A device that is not in the run is paired only with a new device.
      if (!devices[b].measured && !b_is_known) continue;
      pairs.push_back(b_is_known ? pair_of(devices[b], devices[a])
                                 : pair_of(devices[a], devices[b]));
    }
  }
  return pairs;
}

void mark_outliers(const Moved& moved, std::vector<CorrelationPair>& pairs) {
  std::set<std::string_view> named;
  for (std::size_t i = 0; i < moved.records.size(); ++i) {
    if (moved.by[i] != 0) named.insert(moved.records[i]->configuration);
  }
  for (CorrelationPair& pair : pairs) {
    const bool first = pair.device_a == moved.device->name;
    if (!first && pair.device_b != moved.device->name) continue;
    if (!moved.beside.contains(first ? pair.device_b : pair.device_a)) continue;
    for (CorrelationPoint& point : pair.points) {
      point.outlier = point.outlier || named.contains(point.configuration);
    }
  }
}

// Adds a finding for each device of the run whose instructions were not counted.
void report_uncounted(const CorrelationInput& input, const std::vector<DeviceCost>& devices,
                      std::vector<Finding>& findings) {
  std::set<std::string> told;
  for (const DeviceCost& device : devices) {
    if (device.measured) told.insert(device.id);
  }
  for (const record::Record* record : input.records) {
    if (!told.insert(record->device).second) continue;
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
    const Moved moved = movements_of(device, devices);
    if (moved.held.empty()) {
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
