#include "measure/request/error_goal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "measure/contract/factor.hpp"
#include "measure/plan/plan.hpp"
#include "measure/request/error_factor.hpp"

namespace triptych::measure {

const Factor& error_factor(const Suite& suite, std::string_view name) {
  const auto found = std::ranges::find(suite.factors(), name, &Factor::name);
  if (found == suite.factors().end()) {
    throw core::InputError(
        fmt::format("--error works only for volumes, because it chooses the factors step, "
                    "quadrature, ert, skip and adapt; suite {} has no factor {}",
                    suite.name(), name));
  }
  return *found;
}

ErrorGoal error_goal(const std::string& error, const std::set<std::string>& named) {
  ErrorGoal goal{.request = accuracy::parse_requested_error(error)};
  for (const char* factor : error_factors) {
    if (named.contains(factor)) goal.fixed.insert(factor);
  }
  return goal;
}

std::string scene_of(const Suite& suite, Configuration configuration, const ErrorGoal& goal) {
  for (const char* name : error_factors) {
    const Factor& factor = error_factor(suite, name);
    if (goal.chooses(name)) configuration[name] = factor.default_value;
  }
  return configuration_key(suite, configuration);
}

}  // namespace triptych::measure
