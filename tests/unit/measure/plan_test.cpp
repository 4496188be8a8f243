#include "measure/plan/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <set>

#include "plan_fixture.hpp"
#include "record/factor_list.hpp"

namespace triptych::measure {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

std::vector<std::string> values(const Plan& plan, const std::string& factor) {
  std::vector<std::string> result;
  for (const Configuration& each : plan.configurations) result.push_back(each.at(factor));
  return result;
}

TEST_F(PlanTest, ShortNameTakesTheSuitesOwnPlan) {
  const Plan plan = load_plan("fake/quick", {}, find_);
  EXPECT_EQ(plan.name, "fake/quick");
  EXPECT_EQ(plan.suite, "fake");
  EXPECT_THAT(plan.configurations, SizeIs(16));
  EXPECT_THAT(plan.varied, ElementsAre("data", "technique", "step", "camera"));
}

TEST_F(PlanTest, FileIsNamedWithoutItsEnding) {
  EXPECT_EQ(load("suite: fake\n").name, "FileIsNamedWithoutItsEnding");
}

TEST_F(PlanTest, MissingFactorsHaveTheirDefaults) {
  const Plan plan = load("summary: one of each\nsuite: fake\n");
  ASSERT_THAT(plan.configurations, SizeIs(1));
  const Configuration expected{
      {"technique", "raycast"}, {"data", "cube"}, {"sampler", "auto"},       {"step", "1"},
      {"skip", "bricks"},       {"ert", "0"},     {"camera", "orbit_y:0/8"}, {"viewport", "16"}};
  EXPECT_EQ(plan.configurations.front(), expected);
  EXPECT_THAT(plan.varied, IsEmpty());
}

TEST_F(PlanTest, AllViewsOfAPath) {
  const Plan plan = load("suite: fake\ncamera: ['orbit_y:*/3', 'random:7']\n");
  EXPECT_THAT(values(plan, "camera"),
              ElementsAre("orbit_y:0/3", "orbit_y:1/3", "orbit_y:2/3", "random:7"));
}

TEST_F(PlanTest, AutoIsEveryTechniqueThatDraws) {
  const Plan plan = load("suite: fake\ntechnique: auto\n");
  EXPECT_THAT(values(plan, "technique"), ElementsAre("raycast", "raycast_fragment"));
  EXPECT_THAT(plan.automatic, ElementsAre("technique"));
  const Plan set = load_plan("fake/quick", {{"technique", {"auto"}}}, find_);
  EXPECT_THAT(set.configurations, SizeIs(16));
  EXPECT_THAT(set.automatic, ElementsAre("technique"));
  EXPECT_THAT(default_plan(suite_, {{"technique", {"auto"}}}).automatic, ElementsAre("technique"));
}

TEST_F(PlanTest, AutoIsReplacedByANamedLevel) {
  const std::string yaml = "suite: fake\ntechnique: auto\n";
  EXPECT_THAT(load(yaml, {{"technique", {"raycast"}}}).automatic, IsEmpty());
  // `sampler: auto` stands for the device's default sampler, which is known without measuring
  // anything. Therefore it is not listed as automatic.
  EXPECT_THAT(load("suite: fake\nsampler: auto\n").automatic, IsEmpty());
}

TEST_F(PlanTest, DataVariesSlowestCameraFastest) {
  const Plan plan = load(
      "suite: fake\n"
      "camera: [a, b]\n"
      "viewport: [1, 2]\n"
      "skip: [none, bricks]\n"
      "data: [x, y]\n");
  EXPECT_THAT(values(plan, "data"), ElementsAre("x", "x", "x", "x", "x", "x", "x", "x", "y", "y",
                                                "y", "y", "y", "y", "y", "y"));
  EXPECT_THAT(values(plan, "skip"),
              ElementsAre("none", "none", "none", "none", "bricks", "bricks", "bricks", "bricks",
                          "none", "none", "none", "none", "bricks", "bricks", "bricks", "bricks"));
  EXPECT_THAT(values(plan, "camera"), ElementsAre("a", "b", "a", "b", "a", "b", "a", "b", "a", "b",
                                                  "a", "b", "a", "b", "a", "b"));
}

TEST_F(PlanTest, AllCombinationsAreDifferent) {
  const Plan plan = load_plan("fake/quick", {}, find_);
  const std::set<Configuration> distinct(plan.configurations.begin(), plan.configurations.end());
  EXPECT_THAT(distinct, SizeIs(16));
}

TEST_F(PlanTest, NumbersHaveOneSpelling) {
  for (const char* half : {"0.5", ".5", "5e-1", "0.50", "+0.5"}) {
    const Plan plan = load("suite: fake\nstep: " + std::string(half) + "\n");
    EXPECT_THAT(values(plan, "step"), ElementsAre("0.5")) << half;
  }
  EXPECT_THAT(values(load("suite: fake\nstep: [1.0, 2]\n"), "step"), ElementsAre("1", "2"));
  EXPECT_THAT(values(load("suite: fake\nert: -0.0\n"), "ert"), ElementsAre("0"));
}

TEST_F(PlanTest, DefaultsMayBeStatedExplicitly) {
  EXPECT_THAT(values(load("suite: fake\nsampler: [auto, manual]\n"), "sampler"),
              ElementsAre("auto", "manual"));
}

TEST_F(PlanTest, AlsoAddsCombinationsWithoutDuplicates) {
  const std::string yaml =
      "suite: fake\n"
      "data: [x, y]\n"
      "step: [1, 2]\n"
      "also:\n"
      "  - data: x\n"
      "    step: [2, 4]\n"
      "    skip: [none, bricks]\n"
      "  - ert: 0.5\n"
      "    step: 1\n";
  const Plan plan = load(yaml);
  EXPECT_THAT(values(plan, "data"), ElementsAre("x", "x", "x", "x", "x", "x", "y", "y", "y"));
  EXPECT_THAT(values(plan, "step"), ElementsAre("1", "2", "2", "4", "4", "1", "1", "2", "1"));
  EXPECT_THAT(plan.varied, ElementsAre("data", "step", "skip", "ert"));
}

// Overrides with values that occur in the plan select some of the plan's configurations. Overrides
// with other values create new configurations.
TEST_F(PlanTest, OverridesSelectLevelsOfThePlan) {
  const std::string yaml =
      "suite: fake\n"
      "data: [x, y]\n"
      "step: [1, 2]\n"
      "also:\n"
      "  - data: x\n"
      "    step: [2, 4]\n"
      "    skip: [none, bricks]\n"
      "  - ert: 0.5\n"
      "    step: 1\n";
  const std::vector<Configuration> all = load(yaml).configurations;
  for (const Overrides& overrides :
       {Overrides{{"data", {"y"}}, {"ert", {"0"}}}, Overrides{{"skip", {"none"}}},
        Overrides{{"step", {"4", "1"}}}, Overrides{{"ert", {"0.5"}}, {"data", {"x"}}}}) {
    const std::vector<Configuration> some = load(yaml, overrides).configurations;
    std::vector<Configuration> expected;
    for (const Configuration& each : all) {
      const bool chosen = std::ranges::all_of(overrides, [&](const auto& override) {
        return std::ranges::find(override.second, each.at(override.first)) != override.second.end();
      });
      if (chosen) expected.push_back(each);
    }
    ASSERT_FALSE(expected.empty());
    EXPECT_THAT(some, testing::UnorderedElementsAreArray(expected));
  }
  EXPECT_THAT(values(load(yaml, {{"step", {"8"}}}), "step"), testing::Each("8"));
  EXPECT_EQ(values(load(yaml, {{"step", {"8"}}}), "data").size(), 5U);
  // No block of the plan (its beginning, or an entry of `also`) contains both ert=0.5 and step=4.
  // Therefore these levels replace the levels of all blocks.
  EXPECT_THAT(values(load(yaml, {{"ert", {"0.5"}}, {"step", {"4"}}}), "step"), testing::Each("4"));
}

// Invalid plans

TEST_F(PlanTest, AlsoIsAListOfBlocks) {
  EXPECT_THAT(refusal("suite: fake\nalso: 1\n"), AllOf(StartsWith(at(2, 7)), HasSubstr("'also'")));
  EXPECT_THAT(refusal("suite: fake\nalso:\n  - step\n"),
              AllOf(StartsWith(at(3, 5)), HasSubstr("'factor: values'")));
  EXPECT_THAT(refusal("suite: fake\nalso:\n  - stepp: 1\n"),
              AllOf(StartsWith(at(3, 5)), HasSubstr("did you mean 'step'")));
  EXPECT_THAT(refusal("suite: fake\nalso:\n  - step: 1\n    step: 2\n"),
              AllOf(StartsWith(at(4, 5)), HasSubstr("twice")));
}

TEST_F(PlanTest, DifferentPlansHaveDifferentHashes) {
  const std::string hash = load("suite: fake\nstep: [1, 2]\n").hash;
  EXPECT_FALSE(hash.empty());
  EXPECT_EQ(load("suite: fake\nstep: [1, 2]\n", {{"step", {"2"}}}).hash, hash);
  EXPECT_NE(load("suite: fake\nstep: [1, 3]\n").hash, hash);
}

TEST_F(PlanTest, OverridesReplaceAndAdd) {
  const Plan plan =
      load("suite: fake\nstep: [1, 2, 4]\n", {{"step", {".5"}}, {"ert", {"0", "0.1"}}});
  EXPECT_THAT(values(plan, "step"), ElementsAre("0.5", "0.5"));
  EXPECT_THAT(values(plan, "ert"), ElementsAre("0", "0.1"));
}

TEST_F(PlanTest, OverridesAreCheckedLikeThePlan) {
  EXPECT_THAT(refusal("suite: fake\n", {{"stepp", {"1"}}}),
              AllOf(StartsWith("--set stepp: "), HasSubstr("did you mean 'step'")));
  EXPECT_THAT(refusal("suite: fake\n", {{"step", {}}}), HasSubstr("expected factor=value"));
  EXPECT_THAT(refusal("suite: fake\n", {{"step", {"1", "1.0"}}}), HasSubstr("twice"));
  EXPECT_THAT(refusal("suite: fake\n", {{"step", {"1"}}, {"step", {"2"}}}), HasSubstr("twice"));
  EXPECT_THAT(refusal("suite: fake\n", {{"step", {"x"}}}), HasSubstr("expected a number"));
  EXPECT_THAT(refusal("suite: fake\nstep: x\n", {{"step", {"1"}}}), StartsWith(at(2, 7)))
      << "a mistake in the file must still be reported";
}

// Keys and shards

TEST_F(PlanTest, KeysContainOnlyNonDefaultLevels) {
  Configuration configuration = load("suite: fake\n").configurations.front();
  EXPECT_EQ(configuration_key(suite_, configuration),
            "camera=orbit_y:0/8,data=cube,technique=raycast");
  configuration["step"] = "0.5";
  configuration["sampler"] = "manual";
  EXPECT_EQ(configuration_key(suite_, configuration),
            "camera=orbit_y:0/8,data=cube,sampler=manual,step=0.5,technique=raycast");
}

TEST_F(PlanTest, ValuesWithSeparatorsDoNotLookLikeTwo) {
  const Plan plan = load("suite: fake\ndata: ['a,step=2', a]\nstep: [1, 2]\n");
  EXPECT_THAT(values(plan, "data"), ElementsAre("a,step=2", "a,step=2", "a", "a"));
  const Configuration& first = plan.configurations.front();
  EXPECT_EQ(configuration_key(suite_, first),
            "camera=orbit_y:0/8,data=a%2Cstep%3D2,technique=raycast");
  EXPECT_EQ(record::parse_factor_list(scene_key(suite_, first)).at("data"), "a,step=2");
}

TEST_F(PlanTest, KeysOfAPlanAreDistinct) {
  std::set<std::string> keys;
  const Plan plan = load_plan("fake/quick", {}, find_);
  for (const Configuration& each : plan.configurations) {
    keys.insert(configuration_key(suite_, each));
  }
  EXPECT_THAT(keys, SizeIs(plan.configurations.size()));
}

TEST_F(PlanTest, ShardsAreAPartition) {
  const std::string yaml = "suite: fake\ndata: [a, b, c, d, e]\ncamera: [p, q, r]\n";
  const Plan plan = load(yaml);
  for (int count = 1; count <= 17; ++count) {
    std::multiset<Configuration> all;
    std::size_t least = plan.configurations.size();
    std::size_t most = 0;
    for (int index = 1; index <= count; ++index) {
      const Plan shard = load(yaml, {}, {index, count});
      EXPECT_EQ(shard.varied, plan.varied);
      least = std::min(least, shard.configurations.size());
      most = std::max(most, shard.configurations.size());
      all.insert(shard.configurations.begin(), shard.configurations.end());
    }
    const std::multiset<Configuration> expected(plan.configurations.begin(),
                                                plan.configurations.end());
    EXPECT_EQ(all, expected) << count;
    EXPECT_LE(most - least, 1U) << count;
  }
}

TEST_F(PlanTest, ShardsCutAlongDataSets) {
  const Plan plan = load("suite: fake\ndata: [a, b, c, d]\ncamera: [p, q]\n", {}, {2, 2});
  EXPECT_THAT(values(plan, "data"), ElementsAre("b", "b", "d", "d"));
}

TEST_F(PlanTest, ShardOutOfRange) {
  for (const auto& [index, count] : {std::pair{0, 2}, {3, 2}, {1, 0}, {-1, 2}}) {
    EXPECT_THROW(static_cast<void>(load("suite: fake\n", {}, {index, count})), core::InputError)
        << index << "/" << count;
  }
}

// The plan has five million combinations. A shard must keep only its own part in memory, and a
// listing must keep none.
TEST_F(PlanTest, LargePlansAreListedAndShardedWithoutStoringThem) {
  std::string cameras;
  for (int i = 0; i < 250; ++i) cameras += "random:" + std::to_string(i) + ", ";
  std::string steps;
  for (int i = 1; i <= 200; ++i) steps += std::to_string(0.05 * i) + ", ";
  std::string data;
  for (int i = 0; i < 101; ++i) data += "d" + std::to_string(i) + ", ";
  const std::string yaml =
      "suite: fake\ndata: [" + data + "]\nstep: [" + steps + "]\ncamera: [" + cameras + "]\n";
  EXPECT_THAT(refusal(yaml), HasSubstr("--shard i/n"));
  const Plan shard = load(yaml, {}, {7, 1000});
  EXPECT_THAT(shard.configurations, SizeIs(5050));
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  std::size_t count = 0;
  list_plan(file_.string(), {}, find_, {}, [&](const Suite&, const Configuration&) { ++count; });
  EXPECT_EQ(count, 5'050'000U);
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 20 << 10) << "KiB";
}

// A plan with 10¹² combinations can be neither run nor listed, so it must be rejected before the
// first combination is generated.
TEST_F(PlanTest, TooManyCombinationsAreRejectedBeforeListing) {
  std::string values;
  for (int i = 1; i <= 1000; ++i) values += std::to_string(0.01 * i) + ", ";
  std::string cameras;
  for (int i = 0; i < 1000; ++i) cameras += "random:" + std::to_string(i) + ", ";
  std::string data;
  for (int i = 0; i < 1000; ++i) data += "d" + std::to_string(i) + ", ";
  const std::string yaml =
      "suite: fake\ndata: [" + data + "]\nstep: [" + values + "]\ncamera: [" + cameras + "]\n";
  EXPECT_THAT(refusal(yaml), HasSubstr("more than 1000000 combinations"));
  int listed = 0;
  EXPECT_THROW(list_plan(file_.string(), {}, find_, {},
                         [&](const Suite&, const Configuration&) { ++listed; }),
               core::InputError);
  EXPECT_EQ(listed, 0);
}

TEST_F(PlanTest, ChecksDetermineWhatIsMeasured) {
  const Plan standard = load("suite: fake\n");
  EXPECT_TRUE(standard.timed());
  EXPECT_FALSE(standard.counted());
  EXPECT_EQ(record::text_of(standard.checks), "image,counters,statistics,memory,timing");
  const Plan counted = load("suite: fake\nchecks: [memory, cost]\n");
  EXPECT_FALSE(counted.timed());
  EXPECT_TRUE(counted.counted());
  EXPECT_TRUE(standard.judges_images());
  EXPECT_TRUE(standard.judges_counters());
  EXPECT_FALSE(counted.judges_images());
}

TEST_F(PlanTest, InvalidAndMutuallyExclusiveChecks) {
  EXPECT_THAT(
      refusal("suite: fake\nchecks: [image, colour]\n"),
      testing::StartsWith(at(2, 17) + "'checks': unknown check 'colour'; expected one of image"));
  EXPECT_EQ(refusal("suite: fake\nchecks: [image, image]\n"),
            at(2, 17) + "'checks': 'image' is given twice");
  EXPECT_THAT(refusal("suite: fake\nchecks: [timing, cost]\n"),
              testing::HasSubstr("'cost' and 'timing' cannot be combined"));
}

TEST(PlanName, IsWhatRunsAreStoredUnder) {
  EXPECT_EQ(plan_name("volume/quick"), "volume/quick");
  EXPECT_EQ(plan_name("some/where/mine.yaml"), "mine");
  EXPECT_EQ(plan_name("./volume/quick"), "quick");
  EXPECT_EQ(plan_name("mine"), "mine");
}

}  // namespace
}  // namespace triptych::measure
