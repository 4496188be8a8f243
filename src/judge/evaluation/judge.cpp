#include "judge/evaluation/judge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/json.hpp"
#include "judge/timing/model.hpp"

namespace triptych::judge {
namespace {

// By the first launch, then, where there is a second, by what both say of devices in doubt.
void judge_by(const Baselines& baselines, const Launch& first, const std::optional<Launch>& second,
              const GateRequest& request, Trial trial,
              const std::function<void(const GateResult&, const Trial&)>& count) {
  GateResult result = judge_launches(first, {}, baselines, request);
  trial.confirmed = false;
  count(result, trial);
  if (!second) return;
  if (!result.in_doubt.empty()) {
    const Launch again{second->store, second->run, result.in_doubt};
    result = judge_launches(first, {&again, 1}, baselines, request);
    trial.cost = std::min(trial.cost, trial.cost_again);  // the quieter of the two counts
  }
  trial.confirmed = true;
  count(result, trial);
}

}  // namespace

TrialJudge::TrialJudge(const RunPool& pool, std::set<Check> checks,
                       const std::filesystem::path& folder)
    : pool_(pool), checks_(std::move(checks)), folder_(folder) {
  const std::set<std::string> devices = devices_of(pool);
  devices_.assign(devices.begin(), devices.end());
  std::filesystem::create_directories(folder);
}

const TrialHistory& TrialJudge::history(const std::set<std::size_t>& left_out) {
  auto& known = histories_[left_out];
  if (!known) {
    const auto folder = folder_ / fmt::format("without-{}", fmt::join(left_out, "-"));
    std::filesystem::create_directories(folder);
    known = std::make_unique<TrialHistory>(pool_, left_out, folder);
  }
  return *known;
}

TrialStore& TrialJudge::store(std::size_t run, std::size_t launch) {
  auto& known = stores_[{run, launch}];
  if (!known) {
    known = std::make_unique<TrialStore>(pool_, run,
                                         folder_ / fmt::format("{}-{}.sqlite", run, launch));
  }
  return *known;
}

GateRequest TrialJudge::request(const std::set<Check>& checks,
                                const std::vector<std::string>& devices) const {
  return {.plan = pool_.plan,
          .checks = checks,
          .devices = devices,
          .required_devices = {},
          .truth = {},
          .today = "1970-01-01"};
}

void TrialJudge::judge(const Trial& trial, const Attempt& first,
                       const std::optional<Attempt>& second,
                       const std::vector<std::string>& devices) {
  const bool both = second && pool_.unplanted.size() >= TimingModel::least_runs + 2;
  std::set<std::size_t> judged{first.run};
  TrialStore& one = store(first.run, 0);
  one.exchange(first.changed);
  if (!both) {
    judge_by_all(trial, {one.launch(), std::nullopt, history(judged)}, devices);
  } else {
    judged.insert(second->run);
    TrialStore& two = store(second->run, 1);
    two.exchange(second->changed);
    judge_by_all(trial, {one.launch(), two.launch(), history(judged)}, devices);
    two.restore();
  }
  one.restore();
}

// By all devices' baselines and, for a device that is not known yet, by each other one's alone and
// by the nearest of all others.
void TrialJudge::judge_by_all(const Trial& trial, const Launches& launches,
                              const std::vector<std::string>& devices) {
  const std::vector<std::string>& judged = devices.empty() ? devices_ : devices;
  const auto judge_with = [&](const std::set<std::string>& known, const std::set<Check>& checks,
                              const std::vector<std::string>& of, const auto& count) {
    judge_by(launches.stored.of(known), launches.first, launches.second, request(checks, of), trial,
             count);
  };
  const std::set<std::string> all = devices_of(pool_);
  judge_with(all, checks_, devices, [&](const GateResult& result, const Trial& counted) {
    if (checks_.contains(Check::timing)) {
      count_history(pool_.plan, result, counted, judged, tallies_);
    }
    if (checks_.contains(Check::correlation)) {
      for (const std::string& device : judged) {
        count_deciding(pool_.plan, "correlation, accepted device", device, result, counted,
                       tallies_);
      }
    }
  });
  if (!checks_.contains(Check::correlation)) return;
  std::set<std::string> others = all;
  if (judged.size() == 1) others.erase(judged.front());
  for (const std::string& other : others) {
    judge_with({other}, {Check::correlation}, devices,
               [&](const GateResult& result, const Trial& counted) {
                 count_correlations(pool_.plan, "correlation, new device", result, counted,
                                    tallies_);
               });
  }
  for (const std::string& device : judged) {
    std::set<std::string> known = all;
    known.erase(device);
    if (known.size() < 2) continue;  // the only other one is the nearest
    judge_with(known, {Check::correlation}, {device},
               [&](const GateResult& result, const Trial& counted) {
                 count_deciding(pool_.plan, std::string(by_the_nearest), device, result, counted,
                                tallies_);
               });
  }
}

void TrialJudge::judge_twice(std::size_t run) {
  const auto verdict = [&] {
    return to_json(judge_launches(store(run, 0).launch(), {}, history({run}).of(devices_of(pool_)),
                                  request(checks_, {})))
        .dump();
  };
  tallies_[{"gate", pool_.plan, "all devices"}].same_bytes.count(verdict() == verdict());
  if (checks_.contains(Check::timing)) count_seconds(pool_.unplanted[run]);
}

// All that the protocol does of a configuration.
void TrialJudge::count_seconds(const PooledRun& run) {
  for (const record::Record& each : run.records) {
    double ns = each.loop_wall_ns + each.prepare_ns + each.overhead_ns;
    for (const double frame_ns : each.wall_ns) ns += frame_ns;
    tallies_[{"history", pool_.plan, each.device}].seconds += 1e-9 * ns;
  }
}

}  // namespace triptych::judge
