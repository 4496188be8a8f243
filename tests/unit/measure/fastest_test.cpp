// Tests how technique=auto is resolved, which depends only on records.

#include "measure/request/fastest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_suite.hpp"

namespace triptych::measure {
namespace {

using testing::HasSubstr;

const std::set<std::string> of_techniques{"technique"};

class FastestTest : public testing::Test {
 protected:
  record::Record& add(const std::string& technique, const std::vector<double>& wall_ns,
                      const std::string& device = "null:a", const std::string& data = "cube") {
    record::Record record;
    record.device = device;
    record.outcome = record::Outcome::measured;
    for (const Factor& factor : suite_.factors())
      record.factors[factor.name] = factor.default_value;
    record.factors["technique"] = technique;
    record.factors["data"] = data;
    record.wall_ns = wall_ns;
    return records_.emplace_back(std::move(record));
  }
  [[nodiscard]] std::vector<FastestAnswer> answers() const {
    return answer_fastest(records_, suite_, of_techniques);
  }
  [[nodiscard]] std::string text() const { return describe(answers().at(0), of_techniques); }

  FakeSuite suite_;
  std::vector<record::Record> records_;
};

TEST_F(FastestTest, HasTheFastestFrame) {
  add("raycast", {4e6, 4.1e6, 90e6});
  add("raycast_fragment", {80e6, 2e6, 2.1e6});
  ASSERT_EQ(answers().size(), 1U);
  EXPECT_EQ(text(),
            "null:a camera=orbit_y:0/8,data=cube: raycast_fragment is the fastest, minimum "
            "2.000 ms, median 2.100 ms (wall clock); raycast takes 2.00 times as long");
}

TEST_F(FastestTest, ReportsEquallyFastTechniques) {
  add("raycast", {1.0e6, 1.1e6, 1.2e6});
  add("raycast_fragment", {1.05e6, 1.15e6, 1.3e6});
  EXPECT_THAT(text(), HasSubstr("raycast_fragment takes 1.05 times as long (no clear difference)"));
}

TEST_F(FastestTest, TheFasterOfTwoMeasurementsCounts) {
  add("raycast", {3e6});
  EXPECT_TRUE(answers().empty());
  add("raycast_fragment", {2e6});
  add("raycast", {1e6});
  add("raycast_fragment", {4e6});
  EXPECT_THAT(text(), HasSubstr(": raycast is the fastest, minimum 1.000 ms"));
  EXPECT_THAT(text(), HasSubstr("; raycast_fragment takes 2.00 times as long"));
  EXPECT_EQ(answers().at(0).candidates.size(), 2U);
}

TEST_F(FastestTest, IsChosenForEachSceneAndDevice) {
  for (const char* device : {"null:a", "null:b"}) {
    for (const char* data : {"cube", "ball"}) {
      add("raycast", {1e6}, device, data);
      add("raycast_fragment", {2e6}, device, data);
    }
  }
  // The device null:c has only one candidate, so there is no answer for this device.
  add("raycast", {1e6}, "null:c");
  EXPECT_EQ(answers().size(), 4U);
}

// A device may have separate clocks for dispatches and draws, whose times cannot be compared.
TEST_F(FastestTest, IsFoundWithOneClock) {
  record::Record& trusted = add("raycast", {9e6});
  trusted.device_ns = {1e6};
  trusted.device_clock_trusted = true;
  record::Record& other = add("raycast_fragment", {5e6});
  other.device_ns = {4e6};
  EXPECT_THAT(text(), HasSubstr("raycast_fragment is the fastest, minimum 5.000 ms"));
  records_.back().device_clock_trusted = true;
  EXPECT_THAT(text(), HasSubstr("raycast is the fastest, minimum 1.000 ms, median 1.000 ms "
                                "(device clock)"));
}

// If instructions were counted, the instruction counts decide instead of the times, because the
// choice is then repeatable.
TEST_F(FastestTest, HasTheFewestInstructionsIfTheyWereCounted) {
  add("raycast", {}).cost = {{"device_code", 5'000'000}, {"driver", 1'000'000}, {"libc", 9}};
  add("raycast_fragment", {}).cost = {{"device_code", 2'000'000}, {"driver", 2'000'000}};
  EXPECT_THAT(text(), HasSubstr("raycast_fragment executes the fewest instructions, 4.0 million; "
                                "raycast executes 1.50 times as many"));
}

TEST_F(FastestTest, ReportsUnsupportedTechniques) {
  add("raycast", {1e6});
  record::Record& skipped = add("raycast_fragment", {});
  skipped.outcome = record::Outcome::skipped;
  skipped.reason.detail = "the device lacks fragments" + std::string(200, '.');
  const std::string reason = "(the device lacks fragments.........";
  EXPECT_THAT(text(), HasSubstr("; not drawn: raycast_fragment " + reason));
  EXPECT_EQ(text().find(std::string(100, '.')), std::string::npos) << "the reason is too long";
  records_.front().outcome = record::Outcome::failed;
  EXPECT_THAT(text(), HasSubstr("no technique was measured, so none can be recommended; not drawn: "
                                "raycast (failed); raycast_fragment " +
                                reason));
  for (record::Record& record : records_) record.reason.detail = "the same";
  EXPECT_THAT(text(), HasSubstr("; not drawn: raycast, raycast_fragment (the same)"));
}

TEST_F(FastestTest, CandidatesForTheFastestAreMeasuredAgain) {
  const Plan plan = default_plan(suite_, {{"technique", {"auto"}}});
  ASSERT_EQ(plan.configurations.size(), 2U);
  std::vector<std::size_t> trial_sizes;
  const auto fastest_if_other_takes = [&](double second) {
    trial_sizes.clear();
    return find_fastest(plan, suite_, [&](const Plan& trial) {
      records_.clear();
      for (const Configuration& each : trial.configurations) {
        const bool first = each.at("technique") == "raycast";
        // In the first trial, raycast takes 1.5 ms, as if another program had disturbed it. In
        // later trials, it takes 0.9 ms.
        add(each.at("technique"), {first ? (trial_sizes.empty() ? 1.5e6 : 0.9e6) : second})
            .technique = each.at("technique");
      }
      trial_sizes.push_back(trial.configurations.size());
      return records_;
    });
  };
  const FastestTrials similar = fastest_if_other_takes(1e6);
  EXPECT_EQ(trial_sizes, (std::vector<std::size_t>{2, 2}));
  EXPECT_EQ(similar.answers.at(0).candidates.at(0).record->technique, "raycast");
  const FastestTrials slower = fastest_if_other_takes(9e6);
  EXPECT_EQ(trial_sizes, (std::vector<std::size_t>{2}));
  EXPECT_EQ(slower.answers.at(0).candidates.at(0).record, slower.records.data());
}

}  // namespace
}  // namespace triptych::measure
