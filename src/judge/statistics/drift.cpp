#include "judge/statistics/drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/random.hpp"
#include "judge/statistics/statistics.hpp"

namespace triptych::judge {
namespace {

using Model = DriftModel;

// Ties share the mean of their places.
std::vector<double> ranks_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    const double shared = 0.5 * static_cast<double>(first + end + 1);
    for (; first < end; ++first) ranks[order[first]] = shared;
  }
  return ranks;
}

struct Split {
  std::size_t at = 0;
  double z = 0;  // of the rank sum before it, its largest absolute value
};

// Under exchangeability the sum of k of the ranks 1 … n has mean k(n + 1)/2 and variance
// k(n − k)(n + 1)/12.
Split largest_split(std::span<const double> ranks) {
  Split largest;
  const auto n = static_cast<double>(ranks.size());
  double sum = 0;
  for (std::size_t k = 1; k + Model::least_segment <= ranks.size(); ++k) {
    sum += ranks[k - 1];
    if (k < Model::least_segment) continue;
    const auto before = static_cast<double>(k);
    const double z =
        std::abs(sum - before * (n + 1) / 2) / std::sqrt(before * (n - before) * (n + 1) / 12);
    if (z > largest.z) largest = {.at = k, .z = z};
  }
  return largest;
}

// The largest splits of random orders of n ranks, sorted.
std::vector<double> splits_by_chance(std::size_t n, std::size_t orders) {
  std::vector<double> ranks(n);
  std::iota(ranks.begin(), ranks.end(), 1.0);
  core::Random random(n);
  std::vector<double> largest;
  largest.reserve(orders);
  for (std::size_t i = 0; i < orders; ++i) {
    for (std::size_t last = n - 1; last > 0; --last) {
      const double place = random.uniform(0, static_cast<double>(last + 1));
      std::swap(ranks[last], ranks[static_cast<std::size_t>(place)]);
    }
    largest.push_back(largest_split(ranks).z);
  }
  std::ranges::sort(largest);
  return largest;
}

// Null distributions by length, made when first asked for.
class ChangePoints {
 public:
  std::optional<ChangePoint> operator()(std::span<const double> series) {
    if (series.size() < Model::least_runs) return std::nullopt;
    const Split split = largest_split(ranks_of(series));
    if (split.z == 0) return ChangePoint{};
    // Where no order came near, more are drawn: one of many series is told by a small p alone.
    double p = 1;
    for (const std::size_t orders : {std::size_t{9'999}, std::size_t{199'999}}) {
      p = share_as_large(series.size(), split.z, orders);
      if (p > 1.5 / static_cast<double>(orders + 1)) break;
    }
    return ChangePoint{.at = split.at,
                       .effect = median(series.subspan(split.at)) - median(series.first(split.at)),
                       .p = p};
  }

 private:
  // Of random orders and the one that was seen.
  double share_as_large(std::size_t runs, double z, std::size_t orders) {
    auto [known, missing] = by_chance_.try_emplace({runs, orders});
    if (missing) known->second = splits_by_chance(runs, orders);
    const std::vector<double>& chance = known->second;
    constexpr double rounding = 1e-9;  // of z, so that equal splits are equal
    const auto as_large = chance.end() - std::ranges::lower_bound(chance, z - rounding);
    return static_cast<double>(1 + as_large) / static_cast<double>(1 + orders);
  }

  std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> by_chance_;
};

std::vector<double> finite(std::span<const double> values) {
  std::vector<double> result;
  std::ranges::copy_if(values, std::back_inserter(result),
                       [](double value) { return std::isfinite(value); });
  return result;
}

// Of the indices in `of`: the median over series of their deviation from their own median.
std::vector<double> common_series(std::span<const DriftSeries> series,
                                  std::span<const std::size_t> of) {
  std::size_t runs = 0;
  for (const std::size_t i : of) runs = std::max(runs, series[i].log_times.size());
  std::vector<double> result;
  for (std::size_t run = 0; run < runs; ++run) {
    std::vector<double> deviations;
    for (const std::size_t i : of) {
      const std::vector<double>& times = series[i].log_times;
      if (run >= times.size() || !std::isfinite(times[run])) continue;
      deviations.push_back(times[run] - median(finite(times)));
    }
    result.push_back(median(deviations));
  }
  return result;
}

// A step of the series, its place counted in runs that the series may lack.
std::optional<ChangePoint> change_of(ChangePoints& change_points, std::span<const double> values) {
  auto change = change_points(finite(values));
  if (!change) return change;
  std::size_t run = 0;
  for (std::size_t left = change->at; run < values.size(); ++run) {
    if (!std::isfinite(values[run])) continue;
    if (left-- == 0) break;
  }
  change->at = run;
  return change;
}

}  // namespace

std::optional<ChangePoint> change_point(std::span<const double> series) {
  return ChangePoints{}(series);
}

std::vector<Drift> find_drift(std::span<const DriftSeries> series) {
  std::map<std::string, std::vector<std::size_t>> by_device;
  for (std::size_t i = 0; i < series.size(); ++i) by_device[series[i].device].push_back(i);
  ChangePoints change_points;
  std::vector<Drift> devices;
  std::vector<Drift> configurations;
  for (const auto& [device, members] : by_device) {
    const std::vector<double> common = common_series(series, members);
    if (const auto change = change_of(change_points, common)) {
      devices.push_back({.series = std::nullopt, .device = device, .change = *change});
    }
    for (const std::size_t i : members) {
      std::vector<double> own = series[i].log_times;
      for (std::size_t run = 0; run < own.size(); ++run) own[run] -= common[run];
      if (const auto change = change_of(change_points, own)) {
        configurations.push_back({.series = i, .device = device, .change = *change});
      }
    }
  }
  std::vector<Drift> all = std::move(devices);
  all.insert(all.end(), configurations.begin(), configurations.end());
  std::vector<double> p_values;
  for (const Drift& each : all) p_values.push_back(each.change.p);
  const std::vector<bool> rejected = benjamini_hochberg(p_values, Model::share_of_false_alarms);
  std::vector<Drift> found;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (rejected[i] && all[i].change.effect >= std::log(Model::least_effect)) {
      found.push_back(all[i]);
    }
  }
  return found;
}

}  // namespace triptych::judge
