// Tests the gate's findings about images.

#include <gmock/gmock.h>

#include <limits>

#include "gate_fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;

TEST_F(GateTest, WrongPixelIsARegressionThatVoidsItsTime) {
  accept_first();
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::regression);
  const auto wrong = with(result, Verdict::regression);
  ASSERT_EQ(wrong.size(), 1U) << text(result);
  EXPECT_EQ(wrong[0].test, "volume.quick.image.vulkan:lavapipe");
  EXPECT_EQ(wrong[0].cause, Cause::pixels_over_bound);
  EXPECT_EQ(wrong[0].against, Against::reference);
  EXPECT_EQ(wrong[0].number("pixels_over"), 1);
  EXPECT_EQ(wrong[0].number("pixels"), 48);
  EXPECT_EQ(wrong[0].number("x"), 3);
  EXPECT_EQ(wrong[0].number("y"), 1);
  EXPECT_NEAR(wrong[0].number("bound"), 0.001, 1e-6);
}

TEST_F(GateTest, AWrongImageVoidsItsTimeEvenIfOnlyTimesAreJudged) {
  accept_first();
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
  EXPECT_EQ(wrong[0].cause, Cause::not_finite);
  EXPECT_EQ(wrong[0].number("pixels_not_finite"), 1);
}

TEST_F(GateTest, ADifferentImageSizeIsARegression) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record&, core::Image& image) { image = core::Image(4, 4); });
  const auto wrong = with(gate("b"), Cause::size_differs);
  ASSERT_FALSE(wrong.empty());
  EXPECT_EQ(wrong[0].number("width"), 4);
  EXPECT_EQ(wrong[0].number("expected_width"), 8);
}

TEST_F(GateTest, AChangedReferenceImageIsReported) {
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
  EXPECT_EQ(wrong[0].cause, Cause::reference_changed);
}

// If a plan does not store images, its baselines contain only the hash of the reference image.
TEST_F(GateTest, AReferenceImageIsIdentifiedByItsHash) {
  checks_ = {Check::image, Check::counters};
  accept_first();
  EXPECT_FALSE(std::filesystem::exists(baseline("images")));
  const auto moved = [old = request_.truth](float by) {
    return [old, by](const record::Record& record) {
      TruthPair pair = old(record);
      if (record.scene == front_) pair.truth.rgba[0] += by;
      return pair;
    };
  };
  request_.truth = moved(1e-7F);  // the effect of a different math library
  EXPECT_EQ(gate("accepted").exit_code(), ExitCode::pass) << text(gate("accepted"));
  request_.truth = moved(5e-4F);
  const auto wrong = with(gate("accepted"), Verdict::regression);
  ASSERT_EQ(wrong.size(), 1U) << text(gate("accepted"));
  EXPECT_EQ(wrong[0].cause, Cause::reference_changed);
}

TEST_F(GateTest, DevicesMustAgreeAndTheWorseOneIsReported) {
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
  ASSERT_EQ(wrong.size(), 2U) << text(gate("b"));  // one for each scene
  EXPECT_EQ(wrong[0].device, "gl:llvmpipe-egl");
  EXPECT_EQ(wrong[0].configuration, front_);
  EXPECT_EQ(wrong[0].cause, Cause::devices_disagree);
  EXPECT_GT(wrong[0].number("rmse"), wrong[0].number("rmse_of_other"));
}

TEST_F(GateTest, DifferentPathsNeedNotAgree) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image& image) {
    if (record.device != "gl:llvmpipe-egl" || record.configuration != bricks_) return;
    for (float& value : image.rgba) value += 5e-4F;
    record.kernel_hash = "new";
  });
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
}

TEST_F(GateTest, AMissingReferenceImageDoesNotPass) {
  add_run("a");
  (void)accept_run("a");
  request_.truth = [](const record::Record&) -> TruthPair { throw core::IoError("data is gone"); };
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  EXPECT_EQ(with(result, Cause::no_reference).at(0).detail, "data is gone");
  request_.truth = nullptr;
  EXPECT_EQ(gate("a").exit_code(), ExitCode::cannot_judge);
}

}  // namespace
}  // namespace triptych::judge
