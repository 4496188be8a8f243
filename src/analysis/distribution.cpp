#include "analysis/distribution.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/kolmogorov.hpp"
#include "estimation/statistics.hpp"

namespace triptych::analysis {

using estimation::mean;
namespace {

constexpr int percents[] = {0, 5, 10, 25, 50, 75, 90, 95, 99, 100};
constexpr std::size_t most_replicates = 999;
constexpr std::size_t most_draws = 20'000'000;  // some seconds

double below(const LogNormal& fit, double value) {
  return normal_below((std::log(value) - fit.mu) / fit.sigma);
}

std::size_t bin_count(const std::vector<double>& values, double range) {
  const double spread = record::percentile(values, 0.75) - record::percentile(values, 0.25);
  const double width = 2 * spread / std::cbrt(static_cast<double>(values.size()));
  const double wanted = width > 0 ? std::ceil(range / width) : 60;
  return static_cast<std::size_t>(std::clamp(wanted, 5.0, 60.0));
}

std::optional<Distribution> distribution(std::string of, std::string clock, const Chosen& chosen,
                                         const std::vector<double>& times, std::uint64_t seed) {
  if (times.size() < least_for_distribution) return std::nullopt;
  Distribution result{.of = std::move(of), .clock = std::move(clock), .scope = scope_of(chosen)};
  result.fit = fit_log_normal(times);
  if (!(result.fit.sigma > 0)) return std::nullopt;  // one time throughout
  result.mean = mean(times);
  for (const int percent : percents) {
    result.percentiles.emplace_back(percent, record::percentile(times, percent / 100.0));
  }
  const KsTest test = ks_one_sample(times, [&](double value) { return below(result.fit, value); });
  result.ks_d = test.d;
  result.ks_p = test.p;
  result.replicates = std::clamp<std::size_t>(most_draws / times.size(), 99, most_replicates);
  result.lilliefors_p = lilliefors_p(test.d, times.size(), result.replicates, seed);
  result.linear = histogram(times, false, result.fit);
  result.logarithmic = histogram(times, true, result.fit);
  return result;
}

template <typename Time>
std::vector<double> times_of(const Chosen& chosen, Time time) {
  std::vector<double> times;
  for (const Observation* each : chosen) times.push_back(time(*each));
  return times;
}

}  // namespace

LogNormal fit_log_normal(std::span<const double> values) {
  std::vector<double> logs;
  for (const double value : values) logs.push_back(std::log(value));
  const double mu = mean(logs);
  double squares = 0;
  for (const double each : logs) squares += (each - mu) * (each - mu);
  return {mu, std::sqrt(squares / static_cast<double>(logs.size()))};
}

std::vector<Bin> histogram(std::span<const double> values, bool logarithmic, const LogNormal& fit) {
  std::vector<double> scaled;
  for (const double value : values) scaled.push_back(logarithmic ? std::log10(value) : value);
  const auto [least, most] = std::ranges::minmax(scaled);
  const std::size_t count = bin_count(scaled, most - least);
  const double width = (most - least) / static_cast<double>(count);
  std::vector<Bin> bins(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double from = least + width * static_cast<double>(i);
    const double to = i + 1 == count ? most : from + width;
    bins[i].from = logarithmic ? std::pow(10.0, from) : from;
    bins[i].to = logarithmic ? std::pow(10.0, to) : to;
    bins[i].expected =
        static_cast<double>(values.size()) * (below(fit, bins[i].to) - below(fit, bins[i].from));
  }
  for (const double value : scaled) {
    const auto at = width > 0 ? static_cast<std::size_t>((value - least) / width) : 0;
    ++bins[std::min(at, count - 1)].count;
  }
  return bins;
}

std::vector<Distribution> distributions(const Dataset& dataset, std::uint64_t seed) {
  std::vector<Distribution> result;
  const auto add = [&](std::string of, const std::string& clock, const Chosen& chosen,
                       const std::vector<double>& times) {
    auto each = distribution(std::move(of), clock, chosen, times, seed);
    if (each) result.push_back(std::move(*each));
  };
  const Chosen all = all_of(dataset);
  add("all", dataset.clock, all, times_of(all, [](const Observation& o) { return o.ms; }));
  const bool both =
      std::ranges::all_of(all, [](const Observation* o) { return bool(o->device_ms); });
  if (both && dataset.clock == "device") {
    add("all", "wall", all, times_of(all, [](const Observation& o) { return o.wall_ms; }));
  } else if (both) {
    add("all", "device", all, times_of(all, [](const Observation& o) { return *o.device_ms; }));
  }
  for (const Level& level : split(dataset, "device").levels) {
    Chosen chosen;
    for (const auto& [key, observation] : level.by_key) chosen.push_back(observation);
    add("device=" + level.name, dataset.clock, chosen,
        times_of(chosen, [](const Observation& o) { return o.ms; }));
  }
  return result;
}

}  // namespace triptych::analysis
