#pragma once
// The names of stress data in plans: "stress:CASE" or "stress:CASE:VARIANT". A stress case is a
// scene with which renderers often fail. If another factor, such as the camera, has the level
// `own`, the stress case defines its value.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace triptych::measure {

inline constexpr std::string_view own_level = "own";
inline constexpr std::string_view stress_prefix = "stress:";

// A case from a suite's catalogue, with one of its variants.
template <typename Case>
struct StressChoice {
  const Case* of = nullptr;  // a case in the suite's catalogue
  std::string_view variant;  // one of its variants; empty if it has none
};

template <typename Case>
[[nodiscard]] std::string stress_name(const StressChoice<Case>& choice) {
  return fmt::format("{}{}{}{}", stress_prefix, choice.of->name, choice.variant.empty() ? "" : ":",
                     choice.variant);
}

// Finds the case and the variant that the stress name `data` selects from `cases`, which must
// outlive the result. A Case has the members `name` and `variants`. Returns nullopt if `data` does
// not begin with "stress:". For an unknown case or variant, throws an InputError that lists the
// known names.
template <typename Case>
[[nodiscard]] std::optional<StressChoice<Case>> choose_stress(std::string_view data,
                                                              const std::vector<Case>& cases) {
  if (!data.starts_with(stress_prefix)) return std::nullopt;
  const std::string_view rest = data.substr(stress_prefix.size());
  const std::size_t colon = std::min(rest.find(':'), rest.size());
  const auto found = std::ranges::find(cases, rest.substr(0, colon), &Case::name);
  if (found == cases.end()) {
    std::vector<std::string_view> names;
    for (const Case& each : cases) names.push_back(each.name);
    throw core::InputError(fmt::format("'{}': expected {}CASE, where CASE is one of {}", data,
                                       stress_prefix, fmt::join(names, ", ")));
  }
  const auto& variants = found->variants;
  if (variants.empty()) {
    if (colon == rest.size()) return StressChoice<Case>{&*found, {}};
    throw core::InputError(fmt::format("'{}': the case has no variants; expected {}{}", data,
                                       stress_prefix, found->name));
  }
  const auto known = std::ranges::find(variants, rest.substr(std::min(colon + 1, rest.size())));
  if (known == variants.end()) {
    throw core::InputError(fmt::format("'{}': expected {}{}:VARIANT, where VARIANT is one of {}",
                                       data, stress_prefix, found->name,
                                       fmt::join(variants, ", ")));
  }
  return StressChoice<Case>{&*found, *known};
}

}  // namespace triptych::measure
