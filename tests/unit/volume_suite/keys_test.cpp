// Tests the keys that identify which scene a reference image belongs to.

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
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

TEST(Keys, ChangeWithTheTransferFunctionFile) {
  const test::TemporaryFolder folder;
  const auto suite = make_suite({folder.path()});
  const measure::Configuration configuration = configuration_of(*suite, "a.rgba");
  test::expect_keys_to_follow_the_table(*suite, configuration, folder);
}

// Fixed tables must not be part of the key, so that reference images that are already stored remain
// usable.
TEST(Keys, OmitTablesThatCannotChange) {
  const auto suite = make_suite({});
  for (const char* function : {"haze", "surfaces", "own"}) {
    const measure::Configuration configuration = configuration_of(*suite, function);
    EXPECT_EQ(suite->truth_key(configuration, {}).find("table"), std::string::npos);
    EXPECT_EQ(suite->limit_key(configuration).find("table"), std::string::npos);
  }
}

// Entries stored before the factors `window` and `mapping` existed must still be found under their
// old keys.
TEST(Keys, NameAWindowAndAMappingOnlyIfThereIsOne) {
  const auto suite = make_suite({});
  measure::Configuration configuration = configuration_of(*suite, "haze");
  configuration["data"] = "generate:gaussian_blob:8";
  const measure::Configuration plain = configuration;
  EXPECT_EQ(measure::scene_key(*suite, plain),
            "camera=orbit_y:1/8,data=generate:gaussian_blob:8,quadrature=midpoint,shading=none,"
            "step=1,transfer_function=haze,viewport=8");
  for (const auto& [factor, level] : {std::pair{"window", "0..p90"}, {"mapping", "log"}}) {
    configuration = plain;
    configuration[factor] = level;
    const std::string named = std::string(factor) + "=" + level;
    EXPECT_NE(measure::scene_key(*suite, configuration).find(named), std::string::npos);
    EXPECT_NE(measure::configuration_key(*suite, configuration).find(named), std::string::npos);
    EXPECT_NE(suite->data_hash(configuration), suite->data_hash(plain)) << factor;
    EXPECT_NE(suite->truth_key(configuration, {}), suite->truth_key(plain, {})) << factor;
    EXPECT_NE(suite->limit_key(configuration), suite->limit_key(plain)) << factor;
  }
}

TEST(Keys, NameAComponentOnlyIfOneIsChosen) {
  const auto suite = make_suite({});
  measure::Configuration configuration = configuration_of(*suite, "haze");
  const std::string plain = measure::scene_key(*suite, configuration);
  EXPECT_EQ(plain.find("component"), std::string::npos);
  configuration["component"] = "magnitude";
  EXPECT_NE(measure::scene_key(*suite, configuration).find("component=magnitude"),
            std::string::npos);
  const std::string hash = suite->data_hash(configuration);
  configuration.erase("component");
  EXPECT_EQ(suite->data_hash(configuration), hash) << "stored before components were introduced";
  configuration["component"] = "1";
  EXPECT_THROW((void)suite->data_hash(configuration), core::InputError);
}

TEST(Keys, OfAnAnalyticProblemWithAWindowHaveNoClosedForm) {
  const auto suite = make_suite({});
  measure::Configuration configuration = configuration_of(*suite, "own");
  configuration["data"] = "analytic:v2_ramp:8";
  EXPECT_TRUE(suite->closed_form(configuration));
  configuration["window"] = "0..0.5";
  EXPECT_FALSE(suite->closed_form(configuration));
}

}  // namespace
}  // namespace triptych::volume_suite
