#pragma once
// What both suites' keys have to follow.

#include <gtest/gtest.h>

#include <string>

#include "measure/contract/suite.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::test {

// Truth and limit by a transfer function's file are others once the file is. `configuration` names
// a.rgba, `folder` is where the suite looks for it.
inline void expect_keys_to_follow_the_table(measure::SuiteWithTruth& suite,
                                            const measure::Configuration& configuration,
                                            const TemporaryFolder& folder) {
  folder.write("a.rgba", std::string(1024, '\x10'));
  const std::string truth = suite.truth_key(configuration, {});
  const std::string limit = suite.limit_key(configuration);
  EXPECT_EQ(suite.truth_key(configuration, {}), truth);
  folder.write("a.rgba", std::string(1024, '\x20'));
  EXPECT_NE(suite.truth_key(configuration, {}), truth);
  EXPECT_NE(suite.limit_key(configuration), limit);
}

}  // namespace triptych::test
