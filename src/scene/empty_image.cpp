#include "scene/empty_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace triptych::scene {
namespace {

// Returns the value that is normalised to x.
double value_at(const ValueMapping& values, double x) {
  if (values.mapping == Mapping::linear) return values.lo + x * (values.hi - values.lo);
  return values.lo * std::pow(values.hi / values.lo, x);
}

}  // namespace

std::string empty_image_note(const TransferFunction& function, const ValueMapping& values) {
  // If the range is empty, all values are normalised to 0.
  const bool constant = !(values.lo < values.hi);
  const std::array<double, 2> used = constant ? std::array<double, 2>{0, 0} : values.used;
  if (!is_transparent(function, used[0], used[1])) return {};
  const std::string text = fmt::format(
      "the image is empty, because the transfer function {} is transparent for all values of the "
      "data",
      function.name);
  const auto visible = [](const auto& rgba) { return rgba[3] > 0; };
  const auto first = std::ranges::find_if(function.entries, visible);
  if (first == function.entries.end()) return text + "; all of its entries have the opacity 0";
  if (constant) return text + fmt::format("; all values are equal ({:.6g})", values.lo);
  // Entry k influences the values between the centres of the entries k − 1 and k + 1.
  const auto begin = first - function.entries.begin();
  const auto end = function.entries.size() -
                   static_cast<std::size_t>(std::ranges::find_if(function.entries.rbegin(),
                                                                 function.entries.rend(), visible) -
                                            function.entries.rbegin());
  const double lo = std::max((static_cast<double>(begin) - 0.5) / 256, 0.0);
  const double hi = std::min((static_cast<double>(end) + 0.5) / 256, 1.0);
  return text +
         fmt::format(
             "; with the window {:.6g}..{:.6g}, it is visible only for values between {:.6g} "
             "and {:.6g}",
             values.lo, values.hi, value_at(values, lo), value_at(values, hi));
}

}  // namespace triptych::scene
