#include "report/screen/coverage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>

namespace triptych::report {
namespace {

// The factors that select device code, an API feature or a format. Other factors, such as data,
// cameras and step sizes, have too many levels to be listed.
constexpr std::array<std::string_view, 14> listed_factors{
    "technique", "voxel",   "sampler", "quadrature",         "precision", "shading",   "skip",
    "colour",    "culling", "ray",     "conservative_depth", "transfer",  "structure", "corners"};

void update_largest(Coverage& coverage, const std::string& name, std::uint64_t value,
                    const record::Record& record) {
  Largest& largest = coverage.largest[name];
  if (value <= largest.value) return;
  largest = {.value = value,
             .configuration = fmt::format("{} {}", record.plan, record.configuration)};
}

void add_record(Coverage& coverage, const record::Record& record) {
  ++coverage.configurations;
  for (const std::string_view name : listed_factors) {
    const auto level = record.factors.find(std::string(name));
    if (level != record.factors.end()) coverage.levels[level->first].insert(level->second);
  }
  for (const auto* counts : {&record.counters, &record.statistics}) {
    for (const auto& [name, value] : *counts) update_largest(coverage, name, value, record);
  }
  for (const auto& [kind, bytes] : record.memory) {
    update_largest(coverage, "bytes of " + kind, bytes, record);
  }
}

// Formats a number with spaces between groups of digits: "12 345 678".
std::string grouped_digits(std::uint64_t value) {
  std::string digits = std::to_string(value);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  }
  return digits;
}

}  // namespace

std::map<std::string, Coverage> coverage_of(std::span<const record::Record> records) {
  std::map<std::string, Coverage> coverage;
  for (const record::Record& record : records) {
    if (record.outcome == record::Outcome::measured) add_record(coverage[record.device], record);
  }
  return coverage;
}

double largest_bound(const core::Image& bound) {
  double largest = 0;
  for (std::size_t pixel = 0; pixel < bound.pixel_count(); ++pixel) {
    if (!bound.ids.empty() && bound.ids[pixel] != 0) continue;
    largest = std::max(largest, static_cast<double>(bound.rgba[4 * pixel]));
  }
  return largest;
}

std::string bounds_text(std::vector<WideBound> bounds) {
  if (bounds.empty()) return "no image has a bound above 1/255\n";
  std::ranges::sort(bounds, std::greater{}, &WideBound::bound);
  std::string text =
      "images with a bound above 1/255 (bound, mean number of samples per ray, image):\n";
  for (const WideBound& each : bounds) {
    text += fmt::format("  {:<12.4g}{:>10.0f}  {} {}\n", each.bound, each.samples_per_ray,
                        each.device, each.configuration);
  }
  return text;
}

std::string coverage_text(const std::map<std::string, Coverage>& coverage) {
  std::string text;
  for (const auto& [device, covered] : coverage) {
    text += fmt::format("{}: {} configurations were rendered; levels of each factor:\n", device,
                        covered.configurations);
    for (const auto& [factor, levels] : covered.levels) {
      text += fmt::format("  {:<30}{}\n", factor, fmt::join(levels, ", "));
    }
    text += "  largest values in one frame:\n";
    for (const auto& [name, largest] : covered.largest) {
      if (largest.value == 0) continue;
      text += fmt::format("  {:<40}{:>16}  {}\n", name, grouped_digits(largest.value),
                          largest.configuration);
    }
  }
  return text;
}

std::string coverage_summary(const std::map<std::string, Coverage>& coverage) {
  constexpr std::size_t max_lines = 4;
  if (coverage.size() > max_lines) {
    std::size_t configurations = 0;
    for (const auto& [device, covered] : coverage) configurations += covered.configurations;
    return fmt::format("coverage: {} configurations were drawn on {} devices\n", configurations,
                       coverage.size());
  }
  std::string text;
  for (const auto& [device, covered] : coverage) {
    const auto technique = covered.levels.find("technique");
    std::size_t levels = 0;
    for (const auto& [factor, of_factor] : covered.levels) levels += of_factor.size();
    text += fmt::format(
        "coverage of {}: {} configurations were drawn, with {} techniques and {} levels of {} "
        "factors that select code, API features or formats\n",
        device, covered.configurations,
        technique == covered.levels.end() ? 0 : technique->second.size(), levels,
        covered.levels.size());
  }
  return text;
}

core::Json coverage_json(const std::map<std::string, Coverage>& coverage) {
  core::Json devices = core::Json::object();
  for (const auto& [device, covered] : coverage) {
    core::Json largest = core::Json::object();
    for (const auto& [name, each] : covered.largest) {
      largest[name] = {{"value", each.value}, {"configuration", each.configuration}};
    }
    devices[device] = {{"configurations", covered.configurations},
                       {"levels", covered.levels},
                       {"largest", std::move(largest)}};
  }
  return devices;
}

}  // namespace triptych::report
