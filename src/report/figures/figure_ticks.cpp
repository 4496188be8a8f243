#include <fmt/format.h>

#include <array>
#include <cmath>

#include "report/figures/figure.hpp"

namespace triptych::report {
namespace {

constexpr double slack = 1e-9;  // tolerance for a tick at the end of the axis

// Returns the smallest number of the form 1, 2 or 5 times a power of ten that is at least `step`.
double nice_step(double step) {
  const double power = std::pow(10, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= step * (1 - slack)) return factor * power;
  }
  return 10 * power;
}

// The smallest number of ticks: a single tick does not show the scale of an axis.
constexpr std::size_t min_ticks = 2;

std::vector<double> linear_ticks(double low, double high, int wanted) {
  const double step = nice_step((high - low) / wanted);
  std::vector<double> all;
  const double edge = slack * (high - low);
  for (double i = std::ceil((low - edge) / step); i * step <= high + edge; ++i) {
    all.push_back(i == 0 ? 0 : i * step);
  }
  return all.size() < min_ticks ? linear_ticks(low, high, 2 * wanted) : all;
}

std::vector<double> powers(double low, double high, std::span<const double> factors, int every) {
  std::vector<double> all;
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  for (int power = first; power <= last; ++power) {
    if (power % every != 0) continue;
    for (const double factor : factors) {
      const double value = factor * std::pow(10, power);
      if (value >= low * (1 - slack) && value <= high * (1 + slack)) all.push_back(value);
    }
  }
  return all;
}

}  // namespace

std::vector<double> ticks(double low, double high, bool logarithmic, int wanted) {
  if (!(high > low) || wanted < 1 || !std::isfinite(high - low)) return {low};
  if (!logarithmic) return linear_ticks(low, high, wanted);
  const double decades = std::log10(high / low);
  static constexpr std::array<double, 1> ones{1};
  static constexpr std::array<double, 3> some{1, 2, 5};
  if (decades > wanted) {
    // Shows every `every`-th power of ten, or more of them if too few lie on the axis.
    for (int every = static_cast<int>(std::ceil(decades / wanted)); every > 0; --every) {
      std::vector<double> all = powers(low, high, ones, every);
      if (all.size() >= min_ticks) return all;
    }
  }
  std::vector<double> all = powers(low, high, ones, 1);
  if (all.size() < 3) all = powers(low, high, some, 1);
  return all.size() < 3 ? linear_ticks(low, high, wanted) : all;
}

std::string short_number(double value) {
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size >= 1e15 || size < 1e-3) {
    std::string text = fmt::format("{:.3g}", value);
    // Shortens the exponent: "1e-06" becomes "1e-6".
    if (const auto at = text.find("e-0"); at != std::string::npos) text.erase(at + 2, 1);
    if (const auto at = text.find("e+"); at != std::string::npos) text.erase(at + 1, 1);
    return text;
  }
  static constexpr std::array<std::pair<double, const char*>, 4> units{
      {{1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e4, "k"}}};
  for (const auto& [least, unit] : units) {
    if (size >= least) return fmt::format("{:.4g}{}", value / (least == 1e4 ? 1e3 : least), unit);
  }
  return fmt::format("{:.4g}", value);
}

std::string_view colour_of(std::size_t index) {
  static constexpr std::array<std::string_view, colour_count> all{"c0", "c1", "c2", "c3",
                                                                  "c4", "c5", "c6", "c7"};
  return all[index % all.size()];
}

}  // namespace triptych::report
