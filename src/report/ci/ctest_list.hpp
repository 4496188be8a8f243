#pragma once
// Generates the CTest tests for plans and devices. For each plan and device, a fixture measures
// once, and one test for each check judges the records in the store.

#include <span>
#include <string>
#include <string_view>

#include "record/check.hpp"
#include "record/record.hpp"

namespace triptych::report {

struct PlanTests {
  std::string suite;
  std::string plan;   // the plan as a command-line argument
  std::string stem;   // prefix of the names of the plan's tests
  std::string store;  // the file to which the plan's records are written
  record::Checks checks;
  // If several devices have the same driver, the plan is measured only on the first of them.
  bool one_per_driver = false;
};

// Returns the stem of the names of a plan's tests: "volume.quick" for volume/quick. Characters that
// are not allowed in names of tests and files become '_'.
[[nodiscard]] std::string ctest_stem(std::string_view suite, std::string_view plan);

// Returns the content of the file that CTest reads. Its tests run `program` with the commands
// test-start, test-measure and test-check.
[[nodiscard]] std::string ctest_list(const std::string& program, std::span<const PlanTests> plans,
                                     std::span<const record::Device> devices);

}  // namespace triptych::report
