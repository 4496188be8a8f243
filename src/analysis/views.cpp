#include "analysis/views.hpp"

#include <algorithm>
#include <map>

#include "core/random.hpp"
#include "estimation/statistics.hpp"

namespace triptych::analysis {

using estimation::mean;
using estimation::median;
namespace {

// The first `count` of a Fisher–Yates shuffle of 0 … size − 1.
std::vector<std::size_t> draw(std::size_t size, std::size_t count, core::Random& random) {
  std::vector<std::size_t> indices(size);
  for (std::size_t i = 0; i < size; ++i) indices[i] = i;
  for (std::size_t i = 0; i < count; ++i) {
    const double rest = static_cast<double>(size - i);
    std::swap(indices[i], indices[i + static_cast<std::size_t>(random.uniform() * rest)]);
  }
  indices.resize(count);
  return indices;
}

SubsetTests summary_of(const std::vector<KsTest>& tests) {
  std::vector<double> d;
  std::vector<double> p;
  for (const KsTest& each : tests) {
    d.push_back(each.d);
    p.push_back(each.p);
  }
  return {.subsets = tests.size(),
          .rejected = static_cast<std::size_t>(
              std::ranges::count_if(p, [](double each) { return each < rejection_level; })),
          .d_mean = mean(d),
          .p_minimum = std::ranges::min(p),
          .p_mean = mean(p),
          .p_median = median(p),
          .p_maximum = std::ranges::max(p)};
}

SubsetTests of_samples(const std::vector<double>& all, std::size_t count, core::Random& random) {
  std::vector<KsTest> tests;
  for (std::size_t i = 0; i < subset_count; ++i) {
    std::vector<double> subset;
    for (const std::size_t index : draw(all.size(), count, random)) subset.push_back(all[index]);
    tests.push_back(ks_two_samples(subset, all));
  }
  return summary_of(tests);
}

using ByView = std::map<std::string, std::vector<double>>;

SubsetTests of_views(const ByView& by_view, const std::vector<double>& all, std::size_t count,
                     core::Random& random) {
  std::vector<const std::vector<double>*> views;
  for (const auto& [view, times] : by_view) views.push_back(&times);
  std::vector<KsTest> tests;
  for (std::size_t i = 0; i < subset_count; ++i) {
    std::vector<double> subset;
    for (const std::size_t index : draw(views.size(), count, random)) {
      subset.insert(subset.end(), views[index]->begin(), views[index]->end());
    }
    tests.push_back(ks_two_samples(subset, all));
  }
  return summary_of(tests);
}

}  // namespace

std::vector<PathTest> path_tests(const Dataset& dataset, std::uint64_t seed) {
  constexpr std::string_view camera = "camera";
  const Chosen chosen = fullest_block(all_of(dataset), std::span(&camera, 1));
  std::map<std::string, ByView> by_path;
  ByView by_view;
  std::vector<double> all;
  for (const Observation* each : chosen) {
    const std::string& view = each->factors.at("camera");
    by_path[view_of(view).path][view].push_back(each->ms);
    by_view[view].push_back(each->ms);
    all.push_back(each->ms);
  }
  if (by_path.size() < 2) return {};
  core::Random random(seed);
  std::vector<PathTest> result;
  for (const auto& [path, views] : by_path) {
    std::vector<double> times;
    for (const auto& [view, of_view] : views) {
      times.insert(times.end(), of_view.begin(), of_view.end());
    }
    result.push_back({.path = path,
                      .views = views.size(),
                      .samples = times.size(),
                      .all_views = by_view.size(),
                      .all_samples = all.size(),
                      .test = ks_two_samples(times, all),
                      .of_samples = of_samples(all, times.size(), random),
                      .of_views = of_views(by_view, all, views.size(), random),
                      .scope = scope_of(chosen)});
  }
  return result;
}

}  // namespace triptych::analysis
