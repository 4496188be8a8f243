#include "measure/plan/plan_choice.hpp"

#include <gtest/gtest.h>

#include "core/output_files.hpp"
#include "core/temporary_folder.hpp"
#include "plan_fixture.hpp"

namespace triptych::measure {
namespace {

using Names = std::vector<std::string>;

// fake/quick has 16 configurations, with two levels for each of technique, data, step and camera.
class Selection : public PlanTest {
 protected:
  Names names(const PlanChoice& choice) {
    Names keys;
    for (const Configuration& each : choice.load("fake/quick", find_).configurations) {
      keys.push_back(configuration_key(suite_, each));
    }
    return keys;
  }
};

TEST_F(Selection, FiltersByNameAndKey) {
  EXPECT_EQ(names({}).size(), 16U);
  EXPECT_EQ(names({.filter = {"fake.quick.raycast.ball.*"}}).size(), 4U);
  EXPECT_EQ(names({.filter = {"*step=0.5*"}}).size(), 8U);
  EXPECT_EQ(names({.filter = {"raycast.ball.*", "raycast.cube.*"}}).size(), 8U);
  EXPECT_TRUE(names({.filter = {"ball"}}).empty());
  EXPECT_TRUE(PlanChoice{}.is_whole());
  EXPECT_FALSE(PlanChoice{.filter = {"*"}}.is_whole());
}

TEST_F(Selection, TakesTheCasesOfAFile) {
  const core::TemporaryFolder folder;
  const auto written = [&](const char* name, const std::string& text) {
    core::write_text(folder.path() / name, text);
    return (folder.path() / name).string();
  };
  const Names all = names({});
  const std::string file =
      written("cases", "# two\n" + all[3] + "\nfake.quick.raycast.ball.random_7.s0_5.v8  " +
                           all[9] + "\nfake.other.name\n");
  EXPECT_EQ(names({.caselist = file}).size(), 2U);
  const std::string none = written("none", "# nothing\n");
  EXPECT_THROW(static_cast<void>(names({.caselist = none})), core::InputError);
  EXPECT_THROW(static_cast<void>(names({.caselist = file + "x"})), core::IoError);
}

TEST_F(Selection, AFractionIsTheSameEveryTime) {
  const Names quarter = names({.fraction = "1/4"});
  EXPECT_EQ(quarter.size(), 4U);
  EXPECT_EQ(quarter, names({.fraction = "1/4"}));
  EXPECT_EQ(names({.fraction = "1/1000"}).size(), 1U);
  EXPECT_EQ(names({.fraction = "1/1"}).size(), 16U);
  EXPECT_EQ(names({.filter = {"*.ball.*"}, .fraction = "1/3"}).size(), 3U);
  for (const char* text : {"1/0", "2/3", "0.1", "1/", "1/2x"}) {
    EXPECT_THROW(static_cast<void>(names({.fraction = text})), core::InputError) << text;
  }
}

TEST(PlanChoice, CommasSeparateLevelsUnlessEscaped) {
  const Overrides overrides = PlanChoice{.set = {"step=0.5,1", "data=a%2Cb"}}.overrides();
  ASSERT_EQ(overrides.size(), 2U);
  EXPECT_EQ(overrides[0], (Overrides::value_type{"step", {"0.5", "1"}}));
  EXPECT_EQ(overrides[1], (Overrides::value_type{"data", {"a,b"}}));
  for (const char* text : {"step", "=1", "step="}) {
    EXPECT_THROW(static_cast<void>(PlanChoice{.set = {text}}.overrides()), core::InputError)
        << text;
  }
}

TEST(PlanChoice, APartNumberMustExist) {
  EXPECT_EQ(PlanChoice{}.part().count, 1);
  EXPECT_EQ(PlanChoice{.shard = "2/3"}.part().index, 2);
  for (const char* text : {"0/3", "4/3", "1", "1/", "1/2x", "x/2", "-1/2"}) {
    EXPECT_THROW(static_cast<void>(PlanChoice{.shard = text}.part()), core::InputError) << text;
  }
}

}  // namespace
}  // namespace triptych::measure
