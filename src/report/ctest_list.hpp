#pragma once
// The tests that CTest is told of. Fixtures make each device measure a plan once; the checks judge
// what it left in the store.

#include <span>
#include <string>
#include <string_view>

#include "record/check.hpp"
#include "record/record.hpp"

namespace triptych::report {

struct PlanTests {
  std::string suite;
  std::string plan;   // as commands take it
  std::string stem;   // that names its tests
  std::string store;  // where its records are kept
  record::Checks checks;
};

// "volume.quick" of volume/quick, also of a file quick.yaml of that suite: what names of tests and
// of files can hold.
[[nodiscard]] std::string ctest_stem(std::string_view suite, std::string_view plan);

// The file that CTest reads. Its tests call `program` as test-start, test-measure and test-check.
[[nodiscard]] std::string ctest_list(const std::string& program, std::span<const PlanTests> plans,
                                     std::span<const record::Device> devices);

}  // namespace triptych::report
