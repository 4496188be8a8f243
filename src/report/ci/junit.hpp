#pragma once
#include <map>
#include <span>
#include <string>
#include <utility>

#include "judge/gate/gate.hpp"
#include "report/ci/places.hpp"

namespace triptych::report {

// Facts that the findings do not contain.
struct JunitFacts {
  // The seconds that a configuration took, by plan, device and configuration. Its first test case
  // has them, and the test cases of its other checks have 0, so that sums are right.
  std::map<std::string, std::map<std::pair<std::string, std::string>, double>> seconds = {};
  const FindingPlaces* places = nullptr;  // the source of the attributes `file` and `line`
};

// JUnit XML with a test suite for each plan and check, and a test case for each finding, which has
// the short name of its configuration (record/short_name.hpp). Regressions are failures, what could
// not be judged is an error, and skips have their reasons. Numbers become properties, and so does
// the key of the configuration.
[[nodiscard]] std::string junit(std::span<const judge::GateResult> results,
                                const JunitFacts& facts = {});
[[nodiscard]] std::string junit(const judge::GateResult& result, const JunitFacts& facts = {});

}  // namespace triptych::report
