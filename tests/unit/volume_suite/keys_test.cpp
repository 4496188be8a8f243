// What tells whether a truth is that of the scene as it is now.

#include <gtest/gtest.h>

#include <string>

#include "measure/plan/plan.hpp"
#include "suites/volume/suite.hpp"
#include "support/table_keys.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::volume_suite {
namespace {

measure::Configuration configuration_of(const measure::Suite& suite, const std::string& function) {
  measure::Configuration configuration = measure::default_plan(suite, {}).configurations.front();
  configuration["data"] = "generate:uniform_box:8";
  configuration["transfer_function"] = function;
  configuration["viewport"] = "8";
  return configuration;
}

TEST(Keys, ChangeWithTheTransferFunctionsFile) {
  const test::TemporaryFolder folder;
  const auto suite = make_suite({folder.path()});
  const measure::Configuration configuration = configuration_of(*suite, "a.rgba");
  test::expect_keys_to_follow_the_table(*suite, configuration, folder);
}

// So that truths in stores stay of use.
TEST(Keys, SayNothingOfTablesThatCannotChange) {
  const auto suite = make_suite({});
  for (const char* function : {"haze", "surfaces", "own"}) {
    const measure::Configuration configuration = configuration_of(*suite, function);
    EXPECT_EQ(suite->truth_key(configuration, {}).find("table"), std::string::npos);
    EXPECT_EQ(suite->limit_key(configuration).find("table"), std::string::npos);
  }
}

}  // namespace
}  // namespace triptych::volume_suite
