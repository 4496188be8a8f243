// Tests the keys that identify which scene a reference image belongs to.

#include <gtest/gtest.h>

#include <string>

#include "measure/plan/plan.hpp"
#include "suites/particles/suite.hpp"
#include "support/table_keys.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::particles_suite {
namespace {

measure::Configuration configuration_of(const measure::Suite& suite, const std::string& data) {
  measure::Configuration configuration = measure::default_plan(suite, {}).configurations.front();
  configuration["data"] = data;
  return configuration;
}

TEST(Keys, ChangeWithTheTransferFunctionFile) {
  const test::TemporaryFolder folder;
  const auto suite = make_suite({folder.path()});
  measure::Configuration configuration = configuration_of(*suite, "generate:uniform:10");
  configuration["colour"] = "intensity";
  const std::string preset = suite->truth_key(configuration, {});
  // The key for a preset must not contain a hash of the table, so that reference images that are
  // already stored remain usable.
  EXPECT_EQ(preset.find("table"), std::string::npos);
  configuration["transfer_function"] = "a.rgba";
  test::expect_keys_to_follow_the_table(*suite, configuration, folder);
}

// The key of a stress case must contain the case's own camera, which is not among the factors.
TEST(Keys, ContainTheCameraOfAStressCase) {
  const auto suite = make_suite({});
  measure::Configuration configuration = configuration_of(*suite, "stress:widest");
  for (const char* factor : {"camera", "fov", "viewport"}) configuration[factor] = "own";
  EXPECT_NE(suite->truth_key(configuration, {}).find(" frame "), std::string::npos);
  EXPECT_NE(suite->limit_key(configuration).find(" frame "), std::string::npos);
  configuration["data"] = "generate:uniform:10";
  configuration["camera"] = "orbit_y:1/8";
  configuration["fov"] = "60";
  configuration["viewport"] = "64";
  EXPECT_EQ(suite->truth_key(configuration, {}).find(" frame "), std::string::npos);
}

}  // namespace
}  // namespace triptych::particles_suite
