// What the gate says of pictures.

#include <gmock/gmock.h>

#include <limits>

#include "gate_fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

TEST_F(GateTest, WrongPixelIsARegression) {
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

TEST_F(GateTest, BitsThatAreNotStoredAreToldFromThoseThatAreGone) {
  add_run("a");
  EXPECT_THAT(text(gate("a")), Not(HasSubstr("stored bits")));  // nothing is accepted
  (void)accept_run("a");
  EXPECT_THAT(text(gate("a")), Not(HasSubstr("stored bits")));
  const auto bits = device_file("bits", "gl");
  core::Json content = core::Json::parse(folder_.read(bits));
  content["configurations"].erase(plain_);
  core::write_file(content.dump(1), bits);
  EXPECT_THAT(text(gate("a")), HasSubstr("1 configurations have no stored bits beside others"));
  std::filesystem::remove(bits);
  EXPECT_THAT(text(gate("a")),
              ContainsRegex("[2-9] configurations have no stored bits though the history tells"));
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

}  // namespace
}  // namespace triptych::judge
