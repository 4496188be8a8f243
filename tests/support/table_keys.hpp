#pragma once
// Each reference image and each limit image is stored under a key. Tests of both suites use this
// file to check that these keys depend on the transfer function.

#include <gtest/gtest.h>

#include <string>

#include "measure/contract/suite.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::test {

// Checks that the keys of the reference image and of the limit image change if the transfer
// function's file changes. `configuration` names a.rgba, which the suite finds in `folder`.
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
