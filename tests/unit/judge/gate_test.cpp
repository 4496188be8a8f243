// Tests the gate's findings about counters and statistics, and the verdict on the whole run.

#include <gmock/gmock.h>

#include "gate_fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;

TEST_F(GateTest, AcceptedRunPassesItsGate) {
  add_run("a");
  (void)accept_run("a");
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(result.devices.size(), 3U);
}

TEST_F(GateTest, JudgingAStoreTwiceGivesTheSameBytes) {
  accept_first();
  add_run("b", wrong_image_on("gl:llvmpipe-egl"));
  EXPECT_EQ(text(gate("b")), text(gate("b")));
}

// Printed commands set these variables again, or name the ones that they leave out.
TEST_F(GateTest, AResultContainsTheVariablesThatSelectedTheDrivers) {
  accept_first();
  add_run("b");
  record::Run run = store_.runs().back();
  run.system = {{"os", "Debian"}, {"LD_LIBRARY_PATH", "/next"}, {"OCL_ICD_VENDORS", "/vendors"}};
  store_.add_run(run);
  const GateResult result = gate("b");
  ASSERT_FALSE(result.environments.empty());
  for (const auto& [device, environment] : result.environments) {
    EXPECT_EQ(environment.at("LD_LIBRARY_PATH"), "/next") << device;
    EXPECT_EQ(environment.contains("OCL_ICD_VENDORS"), device.starts_with("opencl:")) << device;
    EXPECT_FALSE(environment.contains("os")) << device;
  }
}

// Counters

TEST_F(GateTest, OneMoreSampleOnTheSameDeviceIsARegression) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.device == "opencl:pocl" && record.configuration == plain_) {
      ++record.counters["samples"];
    }
  });
  const auto wrong = with(gate("b"), Verdict::regression);
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_EQ(wrong[0].check, Check::counters);
  EXPECT_EQ(change_of(wrong[0], "samples").before, 1000000);
  EXPECT_EQ(change_of(wrong[0], "samples").now, 1000001);
}

TEST_F(GateTest, LostAndNewCountersDoNotPass) {
  add_run("a");
  (void)accept_run("a");
  add_run("lost", [](record::Record& record, core::Image&) { record.counters.erase("samples"); });
  EXPECT_EQ(gate("lost").exit_code(), ExitCode::regression);
  add_run("new", [](record::Record& record, core::Image&) { record.counters["bricks"] = 1; });
  EXPECT_EQ(gate("new").exit_code(), ExitCode::cannot_judge);
  add_run("none", [](record::Record& record, core::Image&) { record.counters.clear(); });
  EXPECT_EQ(gate("none").exit_code(), ExitCode::cannot_judge);
}

TEST_F(GateTest, AnotherDeviceMayDifferByOneInTenThousand) {
  add_run("a", [](record::Record& record, core::Image&) {
    if (record.device == "opencl:pocl") record.outcome = record::Outcome::skipped;
  });
  (void)accept_run("a");
  request_.checks = {Check::counters};
  const auto on_pocl = [](std::uint64_t samples) {
    return [samples](record::Record& record, core::Image&) {
      if (record.device == "opencl:pocl") record.counters["samples"] = samples;
    };
  };
  add_run("near", on_pocl(1000100));
  EXPECT_EQ(gate("near").exit_code(), ExitCode::pass) << text(gate("near"));
  add_run("far", on_pocl(1000101));
  const GateResult far = gate("far");
  EXPECT_EQ(far.exit_code(), ExitCode::regression);
  EXPECT_EQ(change_of(far.findings.front(), "samples").accepted.at("llvmpipe"), 1000000);
}

// An accepted driver version must repeat its values exactly. Any other version is treated like a
// different driver.
TEST_F(GateTest, AnotherVersionOfADriverMayDifferByOneInTenThousand) {
  accept_first();
  request_.checks = {Check::counters};
  const auto samples = [](std::uint64_t count) {
    return [count](record::Record& record, core::Image&) { record.counters["samples"] = count; };
  };
  add_run("same", samples(1000100));
  EXPECT_EQ(gate("same").exit_code(), ExitCode::regression);
  driver_versions_ = {{"vulkan:lavapipe", "23.0"}, {"gl:llvmpipe-egl", "23"}, {"opencl:pocl", "9"}};
  add_run("near", samples(1000100));
  EXPECT_EQ(gate("near").exit_code(), ExitCode::pass) << text(gate("near"));
  add_run("far", samples(1000101));
  EXPECT_EQ(gate("far").exit_code(), ExitCode::regression);
  add_run("lost", [](record::Record& record, core::Image&) { record.counters.erase("samples"); });
  EXPECT_EQ(gate("lost").exit_code(), ExitCode::regression);
}

// The driver decides where the edges of a sprite lie, but not which fragments hit the sphere.
// Another version may therefore discard slightly more or fewer fragments, but must keep the same
// number.
TEST_F(GateTest, AnotherVersionOfADriverMayMoveTheEdgesOfSprites) {
  const auto fragments = [](std::uint64_t discarded, std::uint64_t kept) {
    return [=](record::Record& record, core::Image&) {
      record.counters = {{"sprites", 2000},
                         {"fragments", discarded + kept},
                         {"fragments_discarded", discarded},
                         {"fragments_kept", kept}};
    };
  };
  accept_first(fragments(10000, 37614));
  request_.checks = {Check::counters};
  driver_versions_ = {{"vulkan:lavapipe", "23.0"}, {"gl:llvmpipe-egl", "23"}, {"opencl:pocl", "9"}};
  add_run("edges", fragments(10005, 37614));
  EXPECT_EQ(gate("edges").exit_code(), ExitCode::pass) << text(gate("edges"));
  add_run("spheres", fragments(9995, 37619));
  EXPECT_EQ(change_of(gate("spheres").findings.front(), "fragments_kept").now, 37619);
  EXPECT_THAT(gate("spheres").findings.front().accepted_on,
              testing::ElementsAre("gl:llvmpipe-egl", "opencl:pocl", "vulkan:lavapipe"));
  add_run("a row more", fragments(20000, 37614));
  EXPECT_EQ(change_of(gate("a row more").findings.front(), "fragments_discarded").now, 20000);
  driver_versions_.clear();
  add_run("version as accepted", fragments(9995, 37619));
  EXPECT_THAT(gate("version as accepted").findings.front().accepted_on, testing::IsEmpty());
}

// Two drivers were accepted with different values, and both are correct. Another device may report
// any value between them.
TEST_F(GateTest, AnotherDeviceMustBeWithinTheAcceptedRange) {
  const auto count = [](std::uint64_t pocl, std::uint64_t mesa) {
    return [=](record::Record& record, core::Image&) {
      record.counters["samples"] = record.device == "opencl:pocl" ? pocl : mesa;
    };
  };
  accept_first([&](record::Record& record, core::Image& image) {
    count(900000, 1000000)(record, image);
    if (record.device == "gl:llvmpipe-egl") record.outcome = record::Outcome::skipped;
  });
  request_.checks = {Check::counters};
  request_.devices = {"gl:*"};
  add_run("as pocl", count(0, 900000));
  EXPECT_EQ(gate("as pocl").exit_code(), ExitCode::pass) << text(gate("as pocl"));
  add_run("beyond", count(0, 899000));
  EXPECT_EQ(gate("beyond").exit_code(), ExitCode::regression);
  const Change change = change_of(gate("beyond").findings.front(), "samples");
  EXPECT_EQ(change.accepted, (std::map<std::string, double>{{"llvmpipe", 1e6}, {"pocl", 9e5}}));
}

// The suite computes by how much rounding can change the counters of a scene. The gate asks for
// this number only if the counters differ from the accepted ones.
TEST_F(GateTest, TheSuiteStatesHowManyCountsMayDifferOnAnotherDriver) {
  accept_first([](record::Record& record, core::Image&) {
    record.counters["samples"] = 1000;
    if (record.device == "gl:llvmpipe-egl") record.outcome = record::Outcome::skipped;
  });
  request_.checks = {Check::counters};
  request_.devices = {"gl:*"};
  int calls = 0;
  request_.open_counts = [&](const record::Record&) {
    ++calls;
    return std::map<std::string, double>{{"samples", 25}};
  };
  add_run("same", [](record::Record& record, core::Image&) { record.counters["samples"] = 1000; });
  EXPECT_EQ(gate("same").exit_code(), ExitCode::pass) << text(gate("same"));
  EXPECT_EQ(calls, 0);
  add_run("open", [](record::Record& record, core::Image&) { record.counters["samples"] = 975; });
  EXPECT_EQ(gate("open").exit_code(), ExitCode::pass) << text(gate("open"));
  add_run("more", [](record::Record& record, core::Image&) { record.counters["samples"] = 974; });
  EXPECT_EQ(gate("more").exit_code(), ExitCode::regression);
  EXPECT_EQ(change_of(gate("more").findings.front(), "samples").allowed, 25);
  request_.open_counts = [](const record::Record&) -> std::map<std::string, double> {
    throw core::InputError("the data are not here");
  };
  EXPECT_EQ(change_of(gate("open").findings.front(), "samples").allowed, 0);
}

TEST_F(GateTest, MissingCountersAreOneFindingPerDevice) {
  add_run("a");
  (void)accept_run("a", {.only = plain_});
  request_.checks = {Check::counters};
  const auto unjudged = with(gate("a"), Verdict::cannot_judge);
  ASSERT_EQ(unjudged.size(), 3U) << text(gate("a"));
  EXPECT_EQ(unjudged[0].cause, Cause::not_stored);
  EXPECT_EQ(unjudged[0].names.size(), 3U);
}

// Statistics

TEST_F(GateTest, StatisticsAreExactOnTheSameDriver) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.device == "vulkan:lavapipe") record.statistics["fragment_invocations"] = 65;
  });
  const auto wrong = with(gate("b"), Verdict::regression);
  ASSERT_EQ(wrong.size(), 4U);
  EXPECT_EQ(wrong[0].check, Check::statistics);
  EXPECT_EQ(change_of(wrong[0], "fragment_invocations").before, 64);
  EXPECT_EQ(change_of(wrong[0], "fragment_invocations").now, 65);
}

TEST_F(GateTest, StatisticsOfAnotherDriverVersionAreAdvice) {
  accept_first();
  driver_versions_["vulkan:lavapipe"] = "23.0";
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.device == "vulkan:lavapipe") {
      record.statistics = {{"compute_invocations", 49}, {"fragment_invocations", 65}};
    }
  });
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const auto advice = with(result, Verdict::advisory, Check::statistics);
  ASSERT_EQ(advice.size(), 1U);
  EXPECT_EQ(advice[0].fact("driver_version"), "23.0");
  EXPECT_EQ(advice[0].number("differences"), 4);
  EXPECT_EQ(advice[0].changes.size(), 1U);
  EXPECT_EQ(change_of(advice[0], "compute_invocations").now, 49);
}

TEST_F(GateTest, DevicesWithoutStatisticsAreSkipped) {
  add_run("a");
  (void)accept_run("a");
  const auto skipped = with(gate("a"), Verdict::skipped, Check::statistics);
  ASSERT_EQ(skipped.size(), 4U);
  EXPECT_EQ(skipped[0].device, "opencl:pocl");
}

// Tests of the verdict on the whole run

TEST(GateResultTest, Precedence) {
  const auto code = [](std::vector<Verdict> verdicts) {
    GateResult result;
    for (const Verdict verdict : verdicts) {
      Finding finding;
      finding.verdict = verdict;
      result.findings.push_back(finding);
    }
    return result.exit_code();
  };
  using enum Verdict;
  EXPECT_EQ(code({pass, improved, advisory, skipped, waived}), ExitCode::pass);
  EXPECT_EQ(code({pass, cannot_judge, regression}), ExitCode::regression);
  EXPECT_EQ(code({pass, cannot_judge}), ExitCode::cannot_judge);
  EXPECT_EQ(code({skipped, advisory}), ExitCode::cannot_judge);
  EXPECT_EQ(code({}), ExitCode::cannot_judge);
  EXPECT_EQ(code({waived}), ExitCode::pass);
}

// A verdict on one device says nothing about another device.
TEST(GateResultTest, EveryDeviceNeedsAVerdict) {
  GateResult result{.devices = {"gl:a", "vulkan:b"}};
  Finding passed;
  passed.verdict = Verdict::pass;
  passed.device = "gl:a";
  Finding advice = passed;
  advice.verdict = Verdict::advisory;
  advice.device = "vulkan:b";
  result.findings = {passed, advice};
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  EXPECT_EQ(result.undecided_devices(), std::vector<std::string>{"vulkan:b"});
  result.findings[1].verdict = Verdict::improved;
  EXPECT_EQ(result.exit_code(), ExitCode::pass);
}

// If a check were missing from the table, it would never run, and the gate would pass.
TEST(GateResultTest, EveryCheckIsJudged) {
  EXPECT_EQ(judged_checks(), record::every_check());
}

TEST(GateResultTest, NamesRoundTrip) {
  for (const Check check_ : {Check::image, Check::counters, Check::statistics, Check::timing}) {
    EXPECT_EQ(check(name_of(check_)), check_);
  }
  EXPECT_THROW((void)check("colour"), core::InputError);
}

// A data file was replaced under the same name. This is neither a regression of the driver nor a
// pass.
TEST_F(GateTest, ReplacedDataIsReported) {
  const auto with_data = [](const std::string& hash) {
    return [hash](record::Record& record, core::Image&) { record.data_hash = hash; };
  };
  accept_first(with_data("0a0a"));
  add_run("b", with_data("0a0a"));
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  add_run("c", with_data("1b1b"));
  const GateResult result = gate("c");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  const auto findings = with(result, Verdict::cannot_judge);
  ASSERT_EQ(findings.size(), 12U);
  EXPECT_EQ(findings[0].cause, Cause::other_data);
  EXPECT_EQ(findings[0].fact("hash"), "1b1b");
  EXPECT_EQ(findings[0].fact("accepted"), "0a0a");
}

// The data file was replaced after the run, so the reference image would show different data than
// the image.
TEST_F(GateTest, DataThatChangedSinceTheRunAreNotARegression) {
  accept_first([](record::Record& record, core::Image&) { record.data_hash = "0a0a"; });
  request_.data_hash = [](const record::Record&) { return "0a0a"; };
  EXPECT_EQ(gate("accepted").exit_code(), ExitCode::pass) << text(gate("accepted"));
  request_.data_hash = [](const record::Record& record) {
    return record.scene == front_ ? "1b1b" : "";
  };
  const auto findings = with(gate("accepted"), Verdict::cannot_judge);
  ASSERT_EQ(findings.size(), 6U) << text(gate("accepted"));
  EXPECT_EQ(findings[0].cause, Cause::data_changed);
  EXPECT_EQ(findings[0].fact("now"), "1b1b");
  EXPECT_TRUE(with(gate("accepted"), Verdict::regression).empty());
}

// Devices prefer different voxel formats, and the hash of the same data depends on the format.
TEST_F(GateTest, DataHasAHashPerVoxelFormat) {
  const auto with_lavapipe_hash = [](const std::string& hash) {
    return [hash](record::Record& record, core::Image&) {
      const bool floats = record.device == "vulkan:lavapipe";
      record.factors["voxel"] = floats ? "f32" : "u8";
      record.data_hash = floats ? hash : "0a0a";
    };
  };
  accept_first(with_lavapipe_hash("1b1b"));
  add_run("b", with_lavapipe_hash("1b1b"));
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  add_run("c", with_lavapipe_hash("0a0a"));
  EXPECT_EQ(with(gate("c"), Verdict::cannot_judge).size(), 4U);
}

}  // namespace
}  // namespace triptych::judge
