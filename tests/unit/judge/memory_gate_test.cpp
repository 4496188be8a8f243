// Tests the gate's findings about bytes allocated on a device.

#include <gmock/gmock.h>

#include "fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;

class MemoryGateTest : public JudgeTest {
 protected:
  MemoryGateTest() { request_.checks = {Check::memory}; }

  static Tweak with_memory(std::uint64_t buffers, const std::string& excluded_device = {}) {
    return [=](record::Record& record, core::Image&) {
      if (record.device != excluded_device) record.memory = {{"buffers", buffers}, {"images", 100}};
    };
  }
};

TEST_F(MemoryGateTest, TheSameBytesPass) {
  accept_first(with_memory(4096));
  const GateResult result = gate("accepted");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::pass, Check::memory).size(), 12U);
}

TEST_F(MemoryGateTest, OneMoreByteIsARegression) {
  accept_first(with_memory(4096));
  add_run("b", with_memory(4097));
  const auto wrong = with(gate("b"), Verdict::regression);
  ASSERT_EQ(wrong.size(), 12U);
  EXPECT_EQ(change_of(wrong[0], "buffers").before, 4096);
  EXPECT_EQ(change_of(wrong[0], "buffers").now, 4097);
  EXPECT_EQ(change_of(wrong[0], "buffers").unit, Unit::bytes);
}

// The injected slowdown itself allocates memory, for which the device is not to blame.
TEST_F(MemoryGateTest, AnInjectedSlowdownIsNotJudged) {
  accept_first(with_memory(4096));
  add_run("b", [](record::Record& record, core::Image& image) {
    with_memory(4097)(record, image);
    record.injected = "slowdown:1";
  });
  EXPECT_EQ(with(gate("b"), Verdict::regression).size(), 0U);
}

TEST_F(MemoryGateTest, ANewKindOfMemoryIsARegression) {
  accept_first(with_memory(4096));
  add_run("b", [](record::Record& record, core::Image& image) {
    with_memory(4096)(record, image);
    record.memory["staging"] = 1;
  });
  EXPECT_EQ(change_of(with(gate("b"), Verdict::regression).at(0), "staging").now, 1);
}

TEST_F(MemoryGateTest, OneLessByteIsAnImprovement) {
  accept_first(with_memory(4096));
  add_run("b", with_memory(4095));
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass);
  EXPECT_EQ(with(gate("b"), Verdict::improved).size(), 12U);
}

TEST_F(MemoryGateTest, ANewDeviceIsOneLineOfAdvice) {
  accept_first(with_memory(4096, "opencl:pocl"));
  add_run("b", with_memory(4096));
  const auto advice = with(gate("b"), Verdict::advisory);
  ASSERT_EQ(advice.size(), 1U) << text(gate("b"));
  EXPECT_EQ(advice[0].device, "opencl:pocl");
  // A device that reports no memory is skipped.
  EXPECT_EQ(with(gate("accepted"), Verdict::skipped).size(), 1U);
}

TEST_F(MemoryGateTest, MissingMemoryOfAnAcceptedDeviceCannotBeJudged) {
  add_run("a", with_memory(4096));
  (void)accept_run("a", {.only = plain_});
  const auto missing = with(gate("a"), Verdict::cannot_judge, Check::memory);
  ASSERT_EQ(missing.size(), 3U) << text(gate("a"));
  EXPECT_EQ(missing[0].names.size(), 3U);
  (void)accept_run("a");
  add_run("b", with_memory(4096, "gl:llvmpipe-egl"));
  const auto lost = with(gate("b"), Verdict::cannot_judge, Check::memory);
  ASSERT_EQ(lost.size(), 1U) << text(gate("b"));
  EXPECT_EQ(lost[0].cause, Cause::no_longer_reported);
  EXPECT_EQ(lost[0].names.size(), 4U);
}

}  // namespace
}  // namespace triptych::judge
