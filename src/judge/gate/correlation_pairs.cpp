#include "judge/gate/correlation_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "judge/gate/anchor_run.hpp"
#include "judge/gate/stored_scatter.hpp"
#include "judge/statistics/statistics.hpp"
#include "judge/timing/anchor.hpp"
#include "judge/timing/model.hpp"

namespace triptych::judge {
namespace {

// As common_clock with what is stored.
std::string_view common_clock(const record::Record& a, const record::Record& b) {
  return a.clock() == b.clock() ? a.clock() : "wall";
}

// Of ln median of one run's frames, by their own scatter.
double variance_within(const std::vector<double>& samples) {
  const double scale = normal_mad * median_absolute_deviation(samples) / median(samples);
  return variance_of_median_to_mean * scale * scale / static_cast<double>(samples.size());
}

double log_median(const record::Record& record, std::string_view clock) {
  return std::log(median(record.time_ns_by(clock)));
}

CorrelationCase case_of(const record::Record& record, std::string_view clock) {
  CorrelationCase each;
  each.configuration = record.configuration;
  each.factors = record.factors;
  each.factors["technique"] = record.technique;
  each.anchor = is_anchor(record);
  each.log_time_b = log_median(record, clock);
  each.variance_b = variance_within(record.time_ns_by(clock));
  // The quietest round that was not seen again may not be the quietest there is.
  if (const auto gap = record.round_gap()) each.variance_b = std::max(each.variance_b, *gap * *gap);
  return each;
}

class Pairs {
 public:
  Pairs(const RunView& view, const WrongImages& wrong)
      : view_(view),
        anchor_baselines_(view.baselines.of_plan(anchors_plan)),
        stored_(view.baselines.timings_of_all_devices()),
        stored_anchors_(anchor_baselines_.timings_of_all_devices()) {
    for (const record::Record* record : view.measured) {
      // One time for several configurations would weigh as many times.
      if (!record->same_as.empty()) continue;
      if (has_time(*record) && !wrong.contains({record->device, record->configuration})) {
        records_[record->device].push_back(record);
      }
    }
    if (view.request.plan == anchors_plan) return;
    find_scatter_beside_anchors();
    anchors_ = anchors_of(view);
    for (const record::Record& anchor : anchors_) records_[anchor.device].push_back(&anchor);
  }

  [[nodiscard]] std::vector<CorrelationPair> run() const {
    std::vector<CorrelationPair> pairs;
    for (const auto& [id, device] : view_.devices) {
      if (!records_.contains(id)) continue;
      for (const StoredDevice& other : stored_) {
        CorrelationPair pair = against_stored(device, other);
        // A device of whose own runs none but this one is stored has no history.
        if (!pair.of_itself || !pair.cases.empty()) pairs.push_back(std::move(pair));
      }
    }
    for (const auto& [id, device] : view_.devices) {
      for (auto other = view_.devices.upper_bound(id); other != view_.devices.end(); ++other) {
        if (records_.contains(id) && records_.contains(other->first)) {
          pairs.push_back(within_run(other->second, device));
        }
      }
    }
    return pairs;
  }

 private:
  // All that is stored under one key, of the plan and of the anchors' plan.
  [[nodiscard]] StoredTimes stored_under(const std::string& key) const {
    StoredTimes result;
    for (const auto* devices : {&stored_, &stored_anchors_}) {
      for (const StoredDevice& device : *devices) {
        if (device.key == key) result.insert(device.timings.begin(), device.timings.end());
      }
    }
    return result;
  }

  void find_scatter_beside_anchors() {
    for (const StoredDevice& device : stored_) {
      const auto anchors = std::ranges::find(stored_anchors_, device.key, &StoredDevice::key);
      beside_anchors_.push_back(anchors == stored_anchors_.end()
                                    ? KnownVariance{0, 0}
                                    : scatter_beside_anchors(device.timings, anchors->timings,
                                                             view_.records.front().run));
    }
  }

  // Moderated over all stored devices; no degrees where it is known of none.
  [[nodiscard]] KnownVariance beside_anchors(const std::string& key) const {
    const auto known = std::ranges::find_if(
        beside_anchors_, [](const KnownVariance& each) { return each.degrees > 0; });
    if (known == beside_anchors_.end()) return {0, 0};
    const VariancePrior prior = fit_variance_prior(beside_anchors_);
    for (std::size_t i = 0; i < stored_.size(); ++i) {
      if (stored_[i].key == key && beside_anchors_[i].degrees > 0) {
        return moderated(prior, beside_anchors_[i]);
      }
    }
    // Unknown of B, it is taken as others'.
    return {prior.variance, std::max(prior.degrees, known->degrees)};
  }

  [[nodiscard]] CorrelationPair against_stored(const record::Device& device,
                                               const StoredDevice& other) const {
    CorrelationPair pair;
    pair.device = device.id;
    pair.other = other.id;
    pair.other_key = other.key;
    pair.of_itself = other.key == device.key();
    const StoredTimes of_a = stored_under(other.key);
    const StoredTimes of_b = stored_under(device.key());
    const VariancePrior scatter_a = scatter_between_runs(of_a);
    const VariancePrior scatter_b = scatter_between_runs(of_b);
    std::vector<std::size_t> known_runs;  // of B
    for (const record::Record* record : records_.at(device.id)) {
      if (!of_a.contains(record->configuration)) continue;
      const std::string_view clock = common_clock(*record, of_a.at(record->configuration));
      // A run that was accepted is no witness against itself.
      const auto runs_a = runs_by(clock, of_a, record->configuration,
                                  pair.of_itself ? std::string_view(record->run) : "");
      if (runs_a.empty() && pair.of_itself) continue;
      if (runs_a.empty() || record->time_ns_by(clock).empty()) {
        ++(is_anchor(*record) ? pair.unlike_anchors : pair.unlike_clocks);
        continue;
      }
      CorrelationCase each = case_of(*record, clock);
      each.log_time_a = median(runs_a);
      const KnownVariance of_a_run = variance_of_a_run(scatter_a, runs_a);
      each.variance_a = of_a_run.variance * share_of_median(runs_a.size());
      each.degrees_a = of_a_run.degrees;
      if (!each.anchor) {
        pair.stored_runs =
            pair.stored_runs == 0 ? runs_a.size() : std::min(pair.stored_runs, runs_a.size());
      }
      // A run that was accepted is what was accepted, but others are better witnesses of it.
      auto runs_b = runs_by(clock, of_b, record->configuration, record->run);
      if (runs_b.empty()) runs_b = runs_by(clock, of_b, record->configuration);
      // A launch scatters more than its frames; unknown of B, it is taken as A's.
      const KnownVariance of_b_run =
          scatter_b.variance > 0 ? variance_of_a_run(scatter_b, runs_b) : of_a_run;
      if (!runs_b.empty()) {
        each.known_log_time_b = median(runs_b);
        known_runs.push_back(runs_b.size());
      }
      if (of_b_run.variance > each.variance_b) {
        each.variance_b = of_b_run.variance;
        each.degrees_b = of_b_run.degrees;
      }
      each.work = work_change(record->counters, view_.baselines, record->configuration, other.id);
      pair.cases.push_back(std::move(each));
    }
    KnownVariance beside = beside_anchors(device.key());
    if (!known_runs.empty()) {
      beside.variance *= 1 + share_of_median(std::ranges::min(known_runs));
    }
    pair.result = correlate(pair.cases, beside, pair.of_itself);
    return pair;
  }

  [[nodiscard]] CorrelationPair within_run(const record::Device& device,
                                           const record::Device& other) const {
    CorrelationPair pair;
    pair.device = device.id;
    pair.other = other.id;
    pair.other_key = other.key();
    pair.within_run = true;
    std::map<std::string, const record::Record*> of_a;
    for (const record::Record* record : records_.at(other.id)) {
      of_a.emplace(record->configuration, record);
    }
    for (const record::Record* record : records_.at(device.id)) {
      const auto a = of_a.find(record->configuration);
      if (a == of_a.end()) continue;
      const std::string_view clock = common_clock(*record, *a->second);
      if (record->time_ns_by(clock).empty() || a->second->time_ns_by(clock).empty()) {
        ++(is_anchor(*record) ? pair.unlike_anchors : pair.unlike_clocks);
        continue;
      }
      CorrelationCase each = case_of(*record, clock);
      each.log_time_a = log_median(*a->second, clock);
      each.variance_a = variance_within(a->second->time_ns_by(clock));
      each.work = work_change(record->counters, a->second->counters);
      pair.cases.push_back(std::move(each));
    }
    pair.result = correlate(pair.cases);
    return pair;
  }

  const RunView& view_;
  Baselines anchor_baselines_;
  std::vector<StoredDevice> stored_;
  std::vector<StoredDevice> stored_anchors_;
  // Of the program beside its anchors from run to run, of each of stored_ in turn.
  std::vector<KnownVariance> beside_anchors_;
  std::vector<record::Record> anchors_;  // of the latest run of the anchors' plan
  std::map<std::string, std::vector<const record::Record*>> records_;  // by device
};

// Nothing is nearer than a device to itself, whatever of its program is slower today. Of others by
// the correlation of all: a scale beside an offset hides how unlike a level is.
bool is_nearer(const CorrelationPair& pair, const CorrelationPair& than) {
  const auto nearness = [](const CorrelationPair& each) {
    const bool may_fail = each.stored_runs >= TimingModel::least_runs;
    return std::tuple(may_fail, each.of_itself, each.result.rho);
  };
  return nearness(pair) > nearness(than);
}

// One for each device: every other stored device adds a character of its own to the answer, and a
// chance of its own to be wrong.
void choose_deciding(std::vector<CorrelationPair>& pairs) {
  std::map<std::string_view, CorrelationPair*> nearest;
  for (CorrelationPair& pair : pairs) {
    if (pair.within_run || !pair.result.admitted()) continue;
    const auto [known, first] = nearest.try_emplace(pair.device, &pair);
    if (!first && is_nearer(pair, *known->second)) known->second = &pair;
  }
  for (const auto& [device, pair] : nearest) pair->decides = true;
}

}  // namespace

std::vector<CorrelationPair> correlation_pairs(const RunView& view, const WrongImages& wrong) {
  if (view.records.empty()) return {};
  std::vector<CorrelationPair> pairs = Pairs(view, wrong).run();
  choose_deciding(pairs);
  return pairs;
}

std::set<std::string> decided_devices(const std::vector<CorrelationPair>& pairs) {
  std::set<std::string> devices;
  for (const CorrelationPair& pair : pairs) {
    if (pair.decides) devices.insert(pair.device);
  }
  return devices;
}

bool is_beside_what_decides(const CorrelationPair& pair, const std::set<std::string>& decided) {
  return !pair.decides && !pair.of_itself && decided.contains(pair.device);
}

}  // namespace triptych::judge
