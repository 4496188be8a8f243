#pragma once
#include <map>
#include <span>
#include <string>
#include <utility>

#include "judge/gate/gate.hpp"
#include "report/ci/finding_locations.hpp"

namespace triptych::report {

// Facts that the findings do not contain.
struct JunitFacts {
  // The seconds that a configuration took, by plan and by (device, configuration). Its first test
  // case has this time, and the test cases of its other checks have 0, so that sums are correct.
  std::map<std::string, std::map<std::pair<std::string, std::string>, double>> seconds = {};
  const FindingLocations* locations = nullptr;  // the source of the attributes `file` and `line`
};

// Returns JUnit XML with a test suite for each plan and check, and a test case for each finding. A
// test case has the short name of its configuration (record/short_name.hpp). Regressions become
// failures, findings that could not be judged become errors, and advisories and skips become
// skipped tests. The numbers and the configuration key are properties of the test case.
[[nodiscard]] std::string junit(std::span<const judge::GateResult> results,
                                const JunitFacts& facts = {});
[[nodiscard]] std::string junit(const judge::GateResult& result, const JunitFacts& facts = {});

}  // namespace triptych::report
