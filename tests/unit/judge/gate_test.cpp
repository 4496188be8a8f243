// What the gate says of pictures, counters, statistics, and of runs and baselines that are not
// whole.

#include "judge/gate.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <limits>

#include "core/file.hpp"
#include "core/image_io.hpp"
#include "core/json.hpp"
#include "fixture.hpp"
#include "judge/json_file.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using testing::AllOf;
using testing::HasSubstr;

class GateTest : public JudgeTest {
 protected:
  void write_waivers(const std::string& expiry, const std::string& device = "vulkan:*") {
    const core::Json waivers = {{{"device", device},
                                 {"test", "volume.quick.image.*"},
                                 {"reason", "known driver fault"},
                                 {"expiry", expiry}}};
    core::write_file(waivers.dump(), folder_.path() / "baselines" / "waivers.json");
  }
  static JudgeTest::Tweak wrong_image_on(const std::string& device) {
    return [device](record::Record& record, core::Image& image) {
      if (record.device == device && record.configuration == plain_) image.rgba[4 * 11] += 0.01F;
    };
  }
};

TEST_F(GateTest, AcceptedRunPassesItsGate) {
  add_run("a");
  (void)accept_run("a");
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_THAT(result.headline(), HasSubstr("PASS: "));
  EXPECT_THAT(result.headline(), HasSubstr("3 devices"));
}

TEST_F(GateTest, SameStoreJudgedTwiceGivesTheSameBytes) {
  accept_history();
  add_run("b", wrong_image_on("gl:llvmpipe-egl"));
  EXPECT_EQ(text(gate("b")), text(gate("b")));
}

// --- pictures ---

TEST_F(GateTest, WrongPixelIsARegressionThatVoidsItsTime) {
  accept_history();
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::regression);
  EXPECT_THAT(result.headline(), HasSubstr("in image on vulkan:lavapipe"));
  const auto wrong = with(result, Verdict::regression);
  ASSERT_EQ(wrong.size(), 2U) << text(result);  // the bound and the bits
  EXPECT_EQ(wrong[0].test, "volume.quick.image.vulkan:lavapipe");
  EXPECT_THAT(wrong[0].message + wrong[1].message,
              AllOf(HasSubstr("1 of 48 pixels"), HasSubstr("(3, 1)"), HasSubstr("bound 0.001"),
                    HasSubstr("ratio 10"), HasSubstr("RMSE")));
  const auto voided = with(result, Verdict::cannot_judge, Check::timing);
  ASSERT_EQ(voided.size(), 1U);
  EXPECT_EQ(voided[0].configuration, plain_);
  EXPECT_THAT(voided[0].message, HasSubstr("its picture is wrong"));
}

TEST_F(GateTest, AWrongPictureVoidsItsTimeEvenWhenOnlyTimesAreAsked) {
  accept_history();
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  request_.checks = {Check::timing};
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  EXPECT_TRUE(with(result, Verdict::regression).empty());
}

TEST_F(GateTest, PixelsThatAreNotFiniteAreARegression) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image& image) {
    if (record.device == "opencl:pocl") image.rgba[5] = std::numeric_limits<float>::quiet_NaN();
  });
  const auto wrong = with(gate("b"), Verdict::regression, Check::image);
  ASSERT_FALSE(wrong.empty());
  EXPECT_THAT(wrong[0].message, HasSubstr("1 of 48 pixels are not finite"));
}

TEST_F(GateTest, OtherSizeIsARegression) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record&, core::Image& image) { image = core::Image(4, 4); });
  EXPECT_THAT(text(gate("b")), HasSubstr("4x4 pixels where the truth has 8x6"));
}

TEST_F(GateTest, ChangedTruthIsNamedAsSuch) {
  add_run("a");
  (void)accept_run("a");
  request_.truth = [old = request_.truth](const record::Record& record) {
    TruthPair pair = old(record);
    if (record.scene == front_) pair.truth.rgba[0] += 1e-4F;
    return pair;
  };
  const auto wrong = with(gate("a"), Verdict::regression);
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_EQ(wrong[0].configuration, front_);
  EXPECT_EQ(wrong[0].device, "");
  EXPECT_THAT(wrong[0].message, HasSubstr("the scene or the truth changed"));
}

TEST_F(GateTest, OtherBitsFromTheSameCodeAreARegression) {
  add_run("a");
  (void)accept_run("a");
  const auto one_bit = [](record::Record& record, core::Image& image) {
    if (record.device == "opencl:pocl" && record.configuration == bricks_) image.rgba[0] += 1e-6F;
  };
  add_run("b", one_bit);
  const auto wrong = with(gate("b"), Verdict::regression);
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_THAT(wrong[0].message, HasSubstr("other bits from the same device"));
  // Once the device code changed, only the bound counts.
  add_run("c", [&](record::Record& record, core::Image& image) {
    one_bit(record, image);
    record.kernel_hash += "-new";
  });
  const GateResult result = gate("c");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_THAT(text(result), HasSubstr("in 1 of them the bits differ"));
}

TEST_F(GateTest, DevicesMustAgreeAndTheFartherOneIsNamed) {
  const auto tilt = [](float by) {
    return [by](record::Record& record, core::Image& image) {
      if (record.device != "gl:llvmpipe-egl") return;
      for (float& value : image.rgba) value += by;
    };
  };
  add_run("a", tilt(0));
  (void)accept_run("a");
  add_run("b", [&](record::Record& record, core::Image& image) {
    tilt(5e-4F)(record, image);  // within the bound of 1e-3
    record.kernel_hash = "new";
  });
  const auto wrong = with(gate("b"), Verdict::regression);
  ASSERT_EQ(wrong.size(), 2U) << text(gate("b"));  // one per scene
  EXPECT_EQ(wrong[0].device, "gl:llvmpipe-egl");
  EXPECT_EQ(wrong[0].configuration, front_);
  EXPECT_THAT(wrong[0].message, HasSubstr("gl:llvmpipe-egl is farther from the truth"));
}

TEST_F(GateTest, OtherPathsNeedNotAgree) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image& image) {
    if (record.device != "gl:llvmpipe-egl" || record.configuration != bricks_) return;
    for (float& value : image.rgba) value += 5e-4F;
    record.kernel_hash = "new";
  });
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
}

TEST_F(GateTest, NoTruthIsNoPass) {
  add_run("a");
  (void)accept_run("a");
  request_.truth = [](const record::Record&) -> TruthPair { throw core::IoError("data is gone"); };
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  EXPECT_THAT(text(result), HasSubstr("data is gone"));
  request_.truth = nullptr;
  EXPECT_EQ(gate("a").exit_code(), ExitCode::cannot_judge);
}

// --- counters ---

TEST_F(GateTest, OneSampleMoreOnTheSameDeviceIsARegression) {
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
  EXPECT_THAT(wrong[0].message, HasSubstr("samples 1000000 → 1000001"));
}

TEST_F(GateTest, LostAndNewCountersAreNoPass) {
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
  EXPECT_THAT(text(far), HasSubstr("against the other devices' median"));
}

// --- statistics ---

TEST_F(GateTest, StatisticsAreExactOnTheSameDriver) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.device == "vulkan:lavapipe") record.statistics["fragment_invocations"] = 65;
  });
  const auto wrong = with(gate("b"), Verdict::regression);
  ASSERT_EQ(wrong.size(), 4U);
  EXPECT_EQ(wrong[0].check, Check::statistics);
  EXPECT_THAT(wrong[0].message, HasSubstr("fragment_invocations 64 → 65"));
}

TEST_F(GateTest, StatisticsOfAnotherDriverVersionAreAdvice) {
  add_run("a");
  (void)accept_run("a");
  std::filesystem::remove(device_file("statistics", "vulkan"));
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.device == "vulkan:lavapipe") {
      record.statistics = {{"compute_invocations", 49}, {"fragment_invocations", 65}};
    }
  });
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const auto advice = with(result, Verdict::advisory, Check::statistics);
  ASSERT_EQ(advice.size(), 4U);
  EXPECT_THAT(advice[0].message, AllOf(HasSubstr("compute_invocations 49, but 48 on gl-"),
                                       testing::Not(HasSubstr("fragment"))));
}

TEST_F(GateTest, DevicesWithoutStatisticsAreSkipped) {
  add_run("a");
  (void)accept_run("a");
  const auto skipped = with(gate("a"), Verdict::skipped, Check::statistics);
  ASSERT_EQ(skipped.size(), 4U);
  EXPECT_EQ(skipped[0].device, "opencl:pocl");
}

// --- what is not whole ---

TEST_F(GateTest, NoBaselinesNamesTheCommandThatMakesThem) {
  add_run("a");
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  ASSERT_EQ(with(result, Verdict::cannot_judge).size(), 1U) << text(result);
  EXPECT_THAT(with(result, Verdict::cannot_judge).at(0).message,
              HasSubstr("triptych accept volume/quick --reason"));
}

TEST_F(GateTest, AWrongPictureIsSeenWithoutBaselines) {
  add_run("a", wrong_image_on("vulkan:lavapipe"));
  EXPECT_EQ(gate("a").exit_code(), ExitCode::regression);
}

TEST_F(GateTest, EmptyRunCannotBeJudged) {
  add_run("a");
  (void)accept_run("a");
  EXPECT_EQ(gate("unknown").exit_code(), ExitCode::cannot_judge);
  EXPECT_THAT(text(gate("unknown")), HasSubstr("nothing was measured"));
}

TEST_F(GateTest, ARunOfAnotherPlanCannotBeJudged) {
  add_run("a");
  (void)accept_run("a");
  request_.plan = "volume/paper";
  EXPECT_EQ(gate("a").exit_code(), ExitCode::cannot_judge);
}

TEST_F(GateTest, DeviceThatIsNotAskedForIsLeftOut) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  request_.devices = {"gl:*", "opencl:*"};
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  request_.devices = {"metal:*"};
  EXPECT_EQ(gate("b").exit_code(), ExitCode::cannot_judge);
}

TEST_F(GateTest, RequiredDeviceMustHaveMeasured) {
  add_run("a");
  (void)accept_run("a");
  request_.required_devices = {"vulkan:*", "gl:softpipe"};
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  ASSERT_EQ(with(result, Verdict::cannot_judge).size(), 1U);
  EXPECT_THAT(with(result, Verdict::cannot_judge).at(0).message,
              HasSubstr("the required device gl:softpipe"));
}

TEST_F(GateTest, ADeletedPictureCannotBeJudgedBy) {
  add_run("a");
  (void)accept_run("a");
  std::filesystem::remove_all(baseline("images"));
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  EXPECT_EQ(with(result, Verdict::cannot_judge).size(), 2U);
}

TEST_F(GateTest, AReplacedPictureIsAnError) {
  add_run("a");
  (void)accept_run("a");
  for (const auto& entry : std::filesystem::directory_iterator(baseline("images"))) {
    core::write_file(std::string_view("version https://git-lfs"), entry.path());
  }
  EXPECT_THROW((void)gate("a"), core::InputError);
}

TEST_F(GateTest, APictureOfAnotherSceneIsAnError) {
  add_run("a");
  (void)accept_run("a");
  const std::filesystem::directory_iterator first(baseline("images"));
  core::write_file(core::encode_exr(core::Image(8, 6)), first->path());
  EXPECT_THROW((void)gate("a"), core::InputError);
}

TEST_F(GateTest, DeletedCountersCannotBeJudgedBy) {
  add_run("a");
  (void)accept_run("a");
  std::filesystem::remove(baseline("counters.json"));
  EXPECT_EQ(gate("a").exit_code(), ExitCode::cannot_judge);
}

TEST_F(GateTest, DeletedTimingsCannotBeJudgedBy) {
  add_run("a");
  (void)accept_run("a");
  std::filesystem::remove_all(baseline("timings"));
  EXPECT_EQ(gate("a").exit_code(), ExitCode::cannot_judge);
}

TEST_F(GateTest, CorruptBaselineIsAnErrorWithItsLine) {
  add_run("a");
  (void)accept_run("a");
  std::ofstream(baseline("counters.json"))
      << "{\n \"x\": {\n  \"samples\": {\"gl:a\": \"many\"}}}\n";
  try {
    (void)gate("a");
    FAIL() << "no error";
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.place().line, 3);
    EXPECT_THAT(error.what(), AllOf(HasSubstr("counters.json"), HasSubstr("/x/samples/gl:a")));
  }
}

TEST_F(GateTest, ARenamedFileDoesNotSpeakForAnotherDevice) {
  add_run("a");
  (void)accept_run("a");
  std::filesystem::rename(device_file("bits", "gl"), device_file("bits", "vulkan"));
  EXPECT_THROW((void)gate("a"), core::InputError);
}

TEST_F(GateTest, MissingRowsAreNamed) {
  add_run("a");
  (void)accept_run("a");
  store_.add_run({"part", plan, "2026-02-02T00:00:00Z", {}});
  for (record::Record record : store_.records("a")) {
    record.run = "part";
    if (record.device == "opencl:pocl" && record.configuration != bricks_)
      store_.add_record(record);
  }
  for (const auto& entry : store_.devices("a")) {
    if (entry.device.id == "opencl:pocl") store_.add_device("part", entry.device, {});
  }
  const GateResult result = gate("part");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  const auto missing = with(result, Verdict::cannot_judge);
  ASSERT_EQ(missing.size(), 1U) << text(result);
  EXPECT_THAT(missing[0].message, AllOf(HasSubstr("1 of 4"), HasSubstr(bricks_)));
}

TEST_F(GateTest, EveryUnhappyOutcomeIsARegressionOnce) {
  add_run("a");
  (void)accept_run("a");
  using record::Outcome;
  for (const Outcome outcome : {Outcome::failed, Outcome::crashed, Outcome::hung, Outcome::lost}) {
    const std::string run(record::name_of(outcome));
    add_run(run, [&](record::Record& record, core::Image&) {
      if (record.device != "gl:llvmpipe-egl" || record.configuration != plain_) return;
      record.outcome = outcome;
      record.reason = "because";
    });
    const auto wrong = with(gate(run), Verdict::regression);
    ASSERT_EQ(wrong.size(), 1U);
    EXPECT_EQ(wrong[0].message, run + ": because");
    EXPECT_EQ(wrong[0].check, Check::image);
  }
}

TEST_F(GateTest, SkippedIsSkippedUnlessTheSameDeviceDidItBefore) {
  const auto skip = [](record::Record& record, core::Image&) {
    if (record.configuration != bricks_) return;
    record.outcome = record::Outcome::skipped;
    record.reason = "no bricks here";
  };
  add_run("a", skip);
  (void)accept_run("a");
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::skipped, Check::image).size(), 3U);
  EXPECT_THAT(with(result, Verdict::skipped, Check::image).at(0).message,
              HasSubstr("no bricks here"));

  add_run("whole");
  (void)accept_run("whole");
  EXPECT_EQ(gate("a").exit_code(), ExitCode::cannot_judge);
}

TEST_F(GateTest, PlantedFaultIsNamed) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image& image) {
    wrong_image_on("vulkan:lavapipe")(record, image);
    if (record.device == "vulkan:lavapipe") record.planted = "swap_axes";
  });
  EXPECT_THAT(with(gate("b"), Verdict::regression).at(0).message,
              HasSubstr("[planted: swap_axes]"));
}

// --- waivers ---

TEST_F(GateTest, AWaiverExcusesUntilItsExpiry) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  request_.checks = {Check::image};
  write_waivers("2026-03-02");
  const GateResult waived = gate("b");
  EXPECT_EQ(waived.exit_code(), ExitCode::pass) << text(waived);
  ASSERT_EQ(with(waived, Verdict::waived).size(), 2U);
  EXPECT_THAT(with(waived, Verdict::waived).at(0).message, HasSubstr("known driver fault"));

  write_waivers("2026-03-01");
  const GateResult expired = gate("b");
  EXPECT_EQ(expired.exit_code(), ExitCode::regression);
  EXPECT_THAT(with(expired, Verdict::regression).at(0).message, HasSubstr("expired on 2026-03-01"));
}

TEST_F(GateTest, AWaiverOfAnotherDeviceExcusesNothing) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  write_waivers("2027-01-01", "gl:*");
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
}

TEST_F(GateTest, AnExpiredWaiverWithoutUseIsReported) {
  add_run("a");
  (void)accept_run("a");
  write_waivers("2025-01-01");
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::pass);
  EXPECT_THAT(text(result), HasSubstr("expired on 2025-01-01 and excuses nothing"));
}

TEST_F(GateTest, AWaiverNeedsReasonAndDate) {
  add_run("a");
  (void)accept_run("a");
  write_waivers("soon");
  EXPECT_THROW((void)gate("a"), core::InputError);
}

// --- the verdict on the whole ---

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

TEST(GateResultTest, NamesReadBack) {
  for (const Check check_ : {Check::image, Check::counters, Check::statistics, Check::timing}) {
    EXPECT_EQ(check(name_of(check_)), check_);
  }
  EXPECT_THROW((void)check("colour"), core::InputError);
}

// A file that was replaced under its name: no regression of the driver, and never a pass.
TEST_F(GateTest, OtherDataUnderTheSameNameIsNamed) {
  const auto with_data = [](const std::string& hash) {
    return [hash](record::Record& record, core::Image&) { record.data_hash = hash; };
  };
  accept_history(with_data("0a0a"));
  add_run("b", with_data("0a0a"));
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  add_run("c", with_data("1b1b"));
  const GateResult result = gate("c");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  const auto findings = with(result, Verdict::cannot_judge);
  ASSERT_EQ(findings.size(), 12U);
  EXPECT_THAT(findings[0].message, HasSubstr("content hash 1b1b, accepted 0a0a"));
}

// Devices prefer different voxel formats, in which the same data has different hashes.
TEST_F(GateTest, DataHasAHashPerVoxelFormat) {
  const auto with_lavapipe_as = [](const std::string& hash) {
    return [hash](record::Record& record, core::Image&) {
      const bool floats = record.device == "vulkan:lavapipe";
      record.factors["voxel"] = floats ? "f32" : "u8";
      record.data_hash = floats ? hash : "0a0a";
    };
  };
  accept_history(with_lavapipe_as("1b1b"));
  add_run("b", with_lavapipe_as("1b1b"));
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  add_run("c", with_lavapipe_as("0a0a"));
  EXPECT_EQ(with(gate("c"), Verdict::cannot_judge).size(), 4U);
}

}  // namespace
}  // namespace triptych::judge
