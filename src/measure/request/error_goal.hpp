#pragma once
// Describes what `--error E` requests: the error, and the factors whose levels it may choose.

#include <array>
#include <cstddef>
#include <set>
#include <string>

#include "accuracy/requested_error.hpp"
#include "measure/contract/suite.hpp"

namespace triptych::measure {

// The factors whose levels --error chooses unless the user fixes them.
inline constexpr std::array<const char*, 5> error_factors{"adapt", "ert", "quadrature", "skip",
                                                          "step"};

struct ErrorGoal {
  accuracy::RequestedError request;
  std::set<std::string> fixed = {};  // the error_factors whose levels the plan keeps

  [[nodiscard]] bool chooses(const std::string& factor) const { return !fixed.contains(factor); }
};

// Returns the goal for the option `error` as typed by the user. `named` contains the factors that
// the user named on the command line; those of them that --error would otherwise choose are fixed.
// Throws InputError for an invalid error.
[[nodiscard]] ErrorGoal error_goal(const std::string& error, const std::set<std::string>& named);

// Returns the name of the scene to which a configuration belongs, "camera=…,data=…,technique=…". It
// does not contain the factors whose levels the request chooses. Throws InputError for a suite
// without these factors.
[[nodiscard]] std::string scene_of(const Suite& suite, Configuration configuration,
                                   const ErrorGoal& goal);

}  // namespace triptych::measure
