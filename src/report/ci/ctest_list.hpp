#pragma once
// The tests that CTest is given. Fixtures make each device measure a plan once, and the checks
// judge the records in the store.

#include <span>
#include <string>
#include <string_view>

#include "record/check.hpp"
#include "record/record.hpp"

namespace triptych::report {

struct PlanTests {
  std::string suite;
  std::string plan;   // the plan in the form that commands accept
  std::string stem;   // the names of its tests begin with it
  std::string store;  // the store of its records
  record::Checks checks;
  // If several devices have the same driver, only the first one measures the plan.
  bool one_per_driver = false;
};

// "volume.quick" for volume/quick, and also for a file quick.yaml of that suite: letters that names
// of tests and files can contain.
[[nodiscard]] std::string ctest_stem(std::string_view suite, std::string_view plan);

// The file that CTest reads. Its tests call `program` with the commands test-start, test-measure
// and test-check.
[[nodiscard]] std::string ctest_list(const std::string& program, std::span<const PlanTests> plans,
                                     std::span<const record::Device> devices);

}  // namespace triptych::report
