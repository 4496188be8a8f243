#include "comparison/store_diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/glob.hpp"

namespace triptych::comparison {
namespace {

std::map<std::string, std::string> latest_by_plan(const record::Store& store) {
  std::map<std::string, std::string> runs;  // run id by plan
  for (const record::Run& run : latest_runs(store)) runs[run.plan] = run.id;
  return runs;
}

std::map<std::string, record::Device> devices_of(const record::Store& store, const std::string& run,
                                                 const std::vector<std::string>& globs) {
  std::map<std::string, record::Device> devices;
  for (auto& entry : store.devices(run)) {
    if (!globs.empty() && !core::any_glob_matches(globs, entry.device.id)) continue;
    devices.emplace(entry.device.id, entry.device);
  }
  return devices;
}

// Adds an entry for each key that exists in only one of the two maps. `make_entry` creates the
// entry from the key and the side.
template <typename Map, typename MakeEntry>
void add_one_sided(const Map& a, const Map& b, const MakeEntry& make_entry,
                   std::set<OneSidedEntry>& out) {
  for (const auto& [name, value] : a) {
    if (!b.contains(name)) out.insert(make_entry(name, measure::Side::a));
  }
  for (const auto& [name, value] : b) {
    if (!a.contains(name)) out.insert(make_entry(name, measure::Side::b));
  }
}

// Returns whether two differences, which were found in different runs of the same two devices, are
// equal.
bool is_same(const Difference& a, const Difference& b) {
  return a.subject == b.subject && a.name == b.name && a.facts == b.facts && a.worths == b.worths &&
         a.total == b.total;
}

// Adds those differences that are not in the list yet. Each run contains a description of the
// device, so several runs may yield the same difference.
void add_new(const std::vector<Difference>& more, std::vector<Difference>& differences) {
  for (const Difference& each : more) {
    const bool known = std::ranges::any_of(
        differences, [&](const Difference& other) { return is_same(other, each); });
    if (!known) differences.push_back(each);
  }
}

class StoreComparer {
 public:
  StoreComparer(const record::Store& a, const record::Store& b,
                const std::vector<std::string>& devices, measure::Truths& truths)
      : a_(a), b_(b), globs_(devices), truths_(truths) {}

  void add_plan(const std::string& plan, const std::string& run_a, const std::string& run_b) {
    const auto of_a = devices_of(a_, run_a, globs_);
    const auto of_b = devices_of(b_, run_b, globs_);
    add_one_sided(
        of_a, of_b,
        [&](const std::string& device, measure::Side side) {
          return OneSidedEntry{plan, device, side};
        },
        one_sided_);
    for (const auto& [id, device] : of_a) {
      const auto found = of_b.find(id);
      if (found == of_b.end()) continue;
      const RunSide a{a_, run_a, device};
      const RunSide b{b_, run_b, found->second};
      add_device(plan, a, b, diff_runs(a, b, truths_, true));
    }
  }

  void add_plans() {
    const auto of_a = latest_by_plan(a_);
    const auto of_b = latest_by_plan(b_);
    add_one_sided(
        of_a, of_b,
        [](const std::string& plan, measure::Side side) {
          return OneSidedEntry{plan, {}, side};
        },
        one_sided_);
    for (const auto& [plan, run] : of_a) {
      if (const auto found = of_b.find(plan); found != of_b.end()) {
        add_plan(plan, run, found->second);
      }
    }
  }

  [[nodiscard]] StoreDiff diff() && {
    StoreDiff all{.devices = {}, .one_sided = {one_sided_.begin(), one_sided_.end()}};
    for (auto& [id, change] : changes_) all.devices.push_back(std::move(change));
    return all;
  }

 private:
  void add_device(const std::string& plan, const RunSide& a, const RunSide& b, RunDiff diff) {
    DeviceChange& change =
        changes_
            .try_emplace(
                a.device.id,
                DeviceChange{.a = a.device, .b = b.device, .device = {}, .configurations = {}})
            .first->second;
    // A total over all configurations belongs to one plan, so its name gets the plan as a prefix.
    // All other differences in this list belong to the device.
    for (Difference& each : diff.device) {
      if (each.subject == Subject::code_total) each.name = fmt::format("{} {}", plan, each.name);
    }
    add_new(diff.device, change.device);
    for (ConfigurationDiff& each : diff.configurations) {
      each.key = fmt::format("{} {}", plan, each.key);
      change.configurations.push_back(std::move(each));
    }
  }

  const record::Store& a_;
  const record::Store& b_;
  const std::vector<std::string>& globs_;
  measure::Truths& truths_;
  std::map<std::string, DeviceChange> changes_;  // by device
  std::set<OneSidedEntry> one_sided_;
};

}  // namespace

std::vector<DifferenceGroup> groups_of(const DeviceChange& change) {
  std::vector<LocatedDifference> all;
  for (const Difference& each : change.device) all.emplace_back("", each);
  for (const ConfigurationDiff& configuration : change.configurations) {
    for (const Difference& each : configuration.differences) {
      all.emplace_back(configuration.key, each);
    }
  }
  return grouped(all);
}

bool was_measured(const DeviceChange& change) {
  return std::ranges::any_of(change.configurations,
                             [](const ConfigurationDiff& each) { return !each.ended; });
}

bool DeviceChange::has(DifferenceKind kind) const {
  const auto in = [kind](const std::vector<Difference>& differences) {
    return std::ranges::find(differences, kind, &Difference::kind) != differences.end();
  };
  return in(device) || std::ranges::any_of(configurations,
                                           [&](const auto& each) { return in(each.differences); });
}

core::ExitCode StoreDiff::exit_code() const {
  const auto any = [this](DifferenceKind kind) {
    return std::ranges::any_of(devices, [kind](const auto& each) { return each.has(kind); });
  };
  if (any(DifferenceKind::regression)) return core::ExitCode::regression;
  const bool measured = std::ranges::any_of(devices, was_measured);
  const bool all = measured && one_sided.empty() && !any(DifferenceKind::unjudged);
  return all ? core::ExitCode::pass : core::ExitCode::cannot_judge;
}

StoreDiff diff_stores(const record::Store& a, const record::Store& b,
                      const std::vector<std::string>& devices, measure::Truths& truths) {
  StoreComparer comparer(a, b, devices, truths);
  comparer.add_plans();
  return std::move(comparer).diff();
}

}  // namespace triptych::comparison
