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

  // suite() and backend() throw core::InputError for an unknown name. The message lists the known
  // names.
  [[nodiscard]] measure::SuiteWithTruth& suite(std::string_view name) const;
  [[nodiscard]] const measure::Backend& backend(std::string_view api) const;
  [[nodiscard]] measure::FindSuiteWithTruth find_suite() const;
  // Returns the names of all built-in plans, such as "volume/quick".
  [[nodiscard]] std::vector<std::string> plan_names() const;
  // Lists the devices of this machine. If globs are given, opens only the APIs that may have a
  // matching device, because opening the drivers of an API takes about a quarter of a second. If a
  // glob has no match, opens all APIs, so that the error message can list all devices.
  [[nodiscard]] measure::Listing devices(const std::vector<std::string>& globs) const;
  // Lists the same devices as devices(), and the devices that only compile code, for a GPU that is
  // not present (measure::list_compilers()).
  [[nodiscard]] measure::Listing devices_and_compilers(const std::vector<std::string>& globs) const;
  // Throws core::InputError because the option --device is missing. The message lists the devices.
  [[noreturn]] void refuse_missing_device() const;
};

[[nodiscard]] Registry make_registry();

}  // namespace triptych::app
