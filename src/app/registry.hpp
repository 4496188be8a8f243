#pragma once
// All backends and suites of this build.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/backend.hpp"
#include "measure/contract/suite.hpp"
#include "measure/truth/truths.hpp"

namespace triptych::app {

struct Registry {
  std::vector<std::unique_ptr<measure::Backend>> backends;
  std::vector<std::unique_ptr<measure::SuiteWithTruth>> suites;

  // Both throw core::InputError with the known names.
  [[nodiscard]] measure::SuiteWithTruth& suite(std::string_view name) const;
  [[nodiscard]] const measure::Backend& backend(std::string_view api) const;
  [[nodiscard]] measure::FindSuiteWithTruth find_suite() const;
  // The devices of this machine, of those APIs in which any of the globs may match a device (all
  // APIs if there are no globs). Opening the drivers of an API takes a quarter of a second.
  [[nodiscard]] measure::Listing devices(const std::vector<std::string>& globs) const;
  // The same devices, and those that only compile, which measure::list_compilers finds for the
  // globs.
  [[nodiscard]] measure::Listing devices_and_compilers(const std::vector<std::string>& globs) const;
};

[[nodiscard]] Registry make_registry();

}  // namespace triptych::app
