// Tests the gate's findings about instructions per frame.

#include <gmock/gmock.h>

#include "fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;

constexpr std::uint64_t device_code = 1'000'000;
constexpr std::uint64_t driver = 1'000'000;

class CostGateTest : public JudgeTest {
 protected:
  CostGateTest() { request_.checks = {Check::cost}; }

  // Returns a function that stores the same cost in every record, counted by one emulator, and then
  // applies `change` to the record.
  static Tweak counted(const std::function<void(record::Record&)>& change = {}) {
    return [change](record::Record& record, core::Image&) {
      record.cost = {{"device_code", device_code},
                     {"driver", driver},
                     {"libc", 5000},
                     {"allocations", 40},
                     {"misses", 20'000}};
      record.prepare_cost = {{"driver", 1'000'000}};
      record.counted_by = "an emulator 1";
      if (change) change(record);
    };
  }
  // Returns a change of one part of the cost of one configuration on one device.
  static Tweak changed(const std::string& device, const std::string& part, std::int64_t by) {
    return counted([=](record::Record& record) {
      if (record.device != device || record.configuration != plain_) return;
      record.cost[part] =
          static_cast<std::uint64_t>(static_cast<std::int64_t>(record.cost.at(part)) + by);
    });
  }
  static Tweak twice_the_misses(const std::string& technique) {
    return counted([=](record::Record& record) {
      record.technique = technique;
      record.cost["misses"] *= 2;
    });
  }
  // Accepts an unchanged run, and judges a second run with `change`.
  GateResult judge(const Tweak& change) {
    accept_first(counted());
    add_run("b", change);
    return gate("b");
  }
};

TEST_F(CostGateTest, TheSameCountsPass) {
  const GateResult result = judge(counted());
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::pass, Check::cost).size(), 12U);
  EXPECT_TRUE(with(result, Verdict::advisory).empty()) << text(result);
}

TEST_F(CostGateTest, OneInstructionOfDeviceCodeIsARegression) {
  const GateResult result = judge(changed("vulkan:lavapipe", "device_code", 1));
  const auto wrong = with(result, Verdict::regression);
  ASSERT_EQ(wrong.size(), 1U) << text(result);
  EXPECT_EQ(wrong[0].device, "vulkan:lavapipe");
  EXPECT_EQ(wrong[0].configuration, plain_);
  ASSERT_EQ(wrong[0].changes.size(), 1U);
  EXPECT_EQ(change_of(wrong[0], "device_code").before, 1000000);
  EXPECT_EQ(change_of(wrong[0], "device_code").now, 1000001);
  EXPECT_EQ(wrong[0].number("instructions"), 2000001);
}

// A resumed or merged run may contain counts from two emulators.
TEST_F(CostGateTest, CountsOfTwoEmulatorsAreNotJudged) {
  const GateResult result = judge(counted([](record::Record& record) {
    if (record.configuration != plain_) return;
    record.counted_by = "an emulator 2";
    record.cost["device_code"] *= 2;
  }));
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  const auto unjudged = with(result, Verdict::cannot_judge, Check::cost);
  ASSERT_EQ(unjudged.size(), 3U);
  EXPECT_EQ(unjudged[0].cause, Cause::two_counters);
  EXPECT_NE(unjudged[0].fact("counted_by"), unjudged[0].fact("other"));
}

TEST_F(CostGateTest, OneInstructionLessIsAnImprovement) {
  const GateResult result = judge(changed("vulkan:lavapipe", "device_code", -1));
  EXPECT_EQ(result.exit_code(), ExitCode::pass);
  EXPECT_EQ(with(result, Verdict::improved).size(), 1U) << text(result);
}

// Fewer instructions in one part do not compensate for more in another, because each part is judged
// separately.
TEST_F(CostGateTest, ASavingInTheDriverDoesNotOffsetMoreDeviceCode) {
  const GateResult result = judge(counted([](record::Record& record) {
    if (record.configuration != plain_) return;
    record.cost["device_code"] += 1000;
    record.cost["driver"] -= 100'000;
  }));
  const auto wrong = with(result, Verdict::regression);
  ASSERT_EQ(wrong.size(), 3U);
  EXPECT_EQ(change_of(wrong[0], "device_code").now, 1001000);
  EXPECT_EQ(change_of(wrong[0], "driver").now, 900000);
}

// A frame executes two million instructions. The driver's tolerance is 5e-4 of that number plus
// 2,000, which is 3,000 instructions.
TEST_F(CostGateTest, TheDriverMayDifferByItsTolerance) {
  EXPECT_EQ(judge(changed("gl:llvmpipe-egl", "driver", 3000)).exit_code(), ExitCode::pass);
}
TEST_F(CostGateTest, TheDriverMayNotDifferByMore) {
  const auto wrong = with(judge(changed("gl:llvmpipe-egl", "driver", 3001)), Verdict::regression);
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_EQ(change_of(wrong[0], "driver").now, 1003001);
}

// A buffer may begin at a different position within a cache line. Therefore the 20,000 cache misses
// have a tolerance of 16 plus 1 %, which is 216.
TEST_F(CostGateTest, CacheMissesMayDifferByTheirTolerance) {
  EXPECT_EQ(judge(changed("gl:llvmpipe-egl", "misses", 216)).exit_code(), ExitCode::pass);
}
TEST_F(CostGateTest, MoreCacheMissesAreARegressionWithoutMoreInstructions) {
  const auto wrong = with(judge(changed("gl:llvmpipe-egl", "misses", 217)), Verdict::regression);
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_EQ(change_of(wrong[0], "misses").now, 20217);
  EXPECT_EQ(change_of(wrong[0], "misses").unit, Unit::misses);
}
TEST_F(CostGateTest, CacheMissesOfSpeedOfLightAreJudgedToo) {
  EXPECT_EQ(judge(twice_the_misses("speed_of_light")).exit_code(), ExitCode::regression);
}
// The cache misses of sprites vary from run to run, so they are not judged.
TEST_F(CostGateTest, CacheMissesOfParticlesAreShown) {
  const GateResult result = judge(twice_the_misses("quad_ray"));
  EXPECT_TRUE(with(result, Verdict::regression).empty()) << text(result);
  EXPECT_EQ(with(result, Verdict::pass, Check::cost).size(), 12U);
}

TEST_F(CostGateTest, PoclsDriverMayDifferByMore) {
  EXPECT_EQ(judge(changed("opencl:pocl", "driver", 9000)).exit_code(), ExitCode::pass);
}
TEST_F(CostGateTest, PoclsDriverMayNotDifferByAnyAmount) {
  EXPECT_EQ(judge(changed("opencl:pocl", "driver", 9001)).exit_code(), ExitCode::regression);
}

TEST_F(CostGateTest, AtomicsMayChangeTheOrderOfWork) {
  const auto tiles = [](std::uint64_t more) {
    return counted([more](record::Record& record) {
      record.technique = "tiles";
      if (record.device == "opencl:pocl") record.cost["device_code"] += more;
    });
  };
  accept_first(tiles(0));
  add_run("within", tiles(20));
  EXPECT_EQ(gate("within").exit_code(), ExitCode::pass) << text(gate("within"));
  add_run("beyond", tiles(21));
  EXPECT_EQ(gate("beyond").exit_code(), ExitCode::regression);
}

TEST_F(CostGateTest, CountsThatDependOnTheHeapAreNotJudged) {
  const GateResult result = judge(counted([](record::Record& record) {
    record.cost["libc"] *= 3;
    record.cost["program"] = 77;
    record.cost["allocations"] += record.configuration == plain_ ? 10U : 1U;
  }));
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 3U) << text(result);
  EXPECT_EQ(advice[0].cause, Cause::frame_allocations);
  EXPECT_EQ(advice[0].number("configurations"), 4);
  EXPECT_EQ(advice[0].fact("configuration"), plain_);
  EXPECT_EQ(change_of(advice[0], "allocations").now, 50);
}

TEST_F(CostGateTest, AllocationsAreReportedIfAFrameCostsMore) {
  const GateResult result = judge(counted([](record::Record& record) {
    record.cost["driver"] += 10'000;
    record.cost["allocations"] += 10;
  }));
  EXPECT_EQ(change_of(with(result, Verdict::regression).at(0), "allocations").now, 50);
}

TEST_F(CostGateTest, PreparationCostIsShown) {
  const GateResult result = judge(counted([](record::Record& record) {
    if (record.device == "opencl:pocl") record.prepare_cost["driver"] = 1'200'000;
  }));
  EXPECT_EQ(result.exit_code(), ExitCode::pass);
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 1U) << text(result);
  EXPECT_EQ(advice[0].cause, Cause::preparing);
  EXPECT_EQ(advice[0].number("configurations"), 4);
  EXPECT_EQ(change_of(advice[0], "driver").now, 1200000);
}

// The driver version of the device differs from the accepted one, so the changes in cost are no
// regressions, but they must not pass either. One finding summarizes the changes in all
// configurations. The median alone would hide that one configuration became slower.
TEST_F(CostGateTest, AnotherDriverVersionCannotBeJudged) {
  accept_first(counted());
  driver_versions_["vulkan:lavapipe"] = "23.0";
  add_run("b", counted([](record::Record& record) {
            if (record.device != "vulkan:lavapipe") return;
            record.cost["device_code"] -= 200'000;
            if (record.configuration == plain_) record.cost["device_code"] += 800'000;
          }));
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  const auto unjudged = with(result, Verdict::cannot_judge);
  ASSERT_EQ(unjudged.size(), 1U) << text(result);
  EXPECT_EQ(unjudged[0].cause, Cause::other_counter);
  EXPECT_EQ(unjudged[0].fact("driver_version"), "23.0");
  EXPECT_EQ(unjudged[0].fact("other_version"), "22.3.6");
  EXPECT_EQ(unjudged[0].number("configurations"), 4);
  EXPECT_NEAR(unjudged[0].number("median_ratio"), 0.9, 1e-9);
  EXPECT_NEAR(unjudged[0].number("worst_ratio"), 1.3, 1e-9);
  EXPECT_EQ(unjudged[0].fact("configuration"), plain_);
  EXPECT_EQ(unjudged[0].advice.advice, Advice::accept_or_compare);
  EXPECT_EQ(unjudged[0].advice.command, "triptych accept volume/quick --reason TEXT");
  EXPECT_TRUE(with(result, Verdict::regression).empty());
}

// The plan also has checks that reach a verdict. They must not hide that the cost was not judged.
TEST_F(CostGateTest, AnotherDriverVersionDoesNotPassBecauseOfOtherChecks) {
  accept_first(counted());
  driver_versions_["vulkan:lavapipe"] = "23.0";
  add_run("b", counted());
  request_.checks = {Check::image, Check::memory, Check::cost};
  EXPECT_EQ(gate("b").exit_code(), ExitCode::cannot_judge) << text(gate("b"));
}

// CTest skips a test of a single check that has no verdict.
TEST_F(CostGateTest, AnotherDriverVersionIsAnAdvisoryInCTest) {
  accept_first(counted());
  driver_versions_["vulkan:lavapipe"] = "23.0";
  add_run("b", counted());
  request_.decides_each_device = false;
  request_.devices = {"vulkan:lavapipe"};
  const auto findings = gate("b").findings;
  ASSERT_EQ(findings.size(), 1U) << text(gate("b"));
  EXPECT_EQ(findings[0].verdict, Verdict::advisory);
}

TEST_F(CostGateTest, AnotherEmulatorCannotBeJudged) {
  const GateResult result = judge(counted([](record::Record& record) {
    record.counted_by = "an emulator 2";
    record.cost["device_code"] *= 2;
  }));
  const auto unjudged = with(result, Verdict::cannot_judge);
  ASSERT_EQ(unjudged.size(), 3U) << text(result);
  EXPECT_EQ(unjudged[0].fact("counted_by"), "an emulator 2");
  EXPECT_EQ(unjudged[0].fact("other"), "an emulator 1");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
}

TEST_F(CostGateTest, ADeviceWithoutStoredCostCannotBeJudged) {
  accept_first([](record::Record& record, core::Image& image) {
    if (record.device != "opencl:pocl") counted()(record, image);
  });
  add_run("b", counted());
  const auto unjudged = with(gate("b"), Verdict::cannot_judge);
  ASSERT_EQ(unjudged.size(), 1U) << text(gate("b"));
  EXPECT_EQ(unjudged[0].device, "opencl:pocl");
  EXPECT_EQ(unjudged[0].cause, Cause::no_stored_device);
  EXPECT_EQ(unjudged[0].advice.advice, Advice::accept_or_compare);
}

TEST_F(CostGateTest, AConfigurationThatAnAcceptedDriverLacksCannotBeJudged) {
  add_run("a", counted());
  (void)accept_run("a", {.only = plain_});
  const auto missing = with(gate("a"), Verdict::cannot_judge, Check::cost);
  ASSERT_EQ(missing.size(), 3U) << text(gate("a"));
  EXPECT_EQ(missing[0].cause, Cause::not_stored);
  EXPECT_EQ(missing[0].names.size(), 3U);
}

TEST_F(CostGateTest, UncountedConfigurationsAreSkippedUnlessAccepted) {
  accept_first([](record::Record& record, core::Image& image) {
    if (record.device != "opencl:pocl") counted()(record, image);
  });
  EXPECT_EQ(with(gate("accepted"), Verdict::skipped, Check::cost).size(), 1U);
  add_run("none");
  const auto lost = with(gate("none"), Verdict::cannot_judge, Check::cost);
  ASSERT_EQ(lost.size(), 3U) << text(gate("none"));
  EXPECT_EQ(lost[0].cause, Cause::no_longer_reported);
  EXPECT_EQ(lost[1].cause, Cause::nothing_decided);
  EXPECT_EQ(lost[1].device, "opencl:pocl");
  add_run("part", [](record::Record& record, core::Image& image) {
    if (record.configuration != plain_) counted()(record, image);
  });
  const auto part = with(gate("part"), Verdict::cannot_judge, Check::cost);
  ASSERT_EQ(part.size(), 3U) << text(gate("part"));
  EXPECT_EQ(part[0].names, std::vector{plain_});
}

}  // namespace
}  // namespace triptych::judge
