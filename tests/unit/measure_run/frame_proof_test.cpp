// Tests the detection of drivers that report frames as finished without having drawn them.
#include "measure/protocol/frame_proof.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <cstdint>
#include <stdexcept>

#include "measure/contract/not_drawn.hpp"
#include "measure/protocol/clock.hpp"
#include "measure/protocol/protocol.hpp"
#include "tests/unit/measure_run/scripted_prepared.hpp"

namespace triptych::measure {
namespace {

constexpr int warm_up = 4;
constexpr int timed = 8;

void measure_all(Prepared& prepared, const Protocol& protocol = {}) {
  static_cast<void>(measure(prepared, protocol, technique::Work::compute, {}, "test"));
}

TEST(FrameProof, AcceptsFramesThatRepeat) {
  ScriptedPrepared prepared = steady(50 * ms);
  EXPECT_NO_THROW(measure_all(prepared));
  EXPECT_NO_THROW(measure_all(prepared, {.timed = false}));
}

TEST(FrameProof, FindsCommandsThatAreExecutedOnlyOnce) {
  for (const Protocol& protocol : {Protocol{}, Protocol{.timed = false}}) {
    ScriptedPrepared prepared = steady(50 * ms);
    prepared.draws = [](int n) { return n == 1; };
    EXPECT_THROW(measure_all(prepared, protocol), NotDrawn) << protocol.timed;
  }
}

TEST(FrameProof, FindsEachTimedFrameThatIsNotDrawn) {
  for (int missing = 2; missing <= timed; ++missing) {
    ScriptedPrepared prepared = steady(50 * ms);
    prepared.draws = [=](int n) { return n != warm_up + missing; };
    EXPECT_THROW(measure_all(prepared), NotDrawn) << missing;
  }
}

TEST(FrameProof, FindsFramesOfStatisticsCountersAndTheLoopThatAreNotDrawn) {
  for (int after = 1; after <= 3; ++after) {
    ScriptedPrepared prepared = steady(50 * ms);
    prepared.draws = [=](int n) { return n < warm_up + timed + after; };
    EXPECT_THROW(measure_all(prepared), NotDrawn) << after;
  }
}

TEST(FrameProof, FindsAFrameThatDrawsSomethingElse) {
  ScriptedPrepared prepared = steady(50 * ms);
  prepared.value_of_frame = [](int n) { return n == warm_up + timed ? 0.5F : 1.0F; };
  EXPECT_THROW(measure_all(prepared), NotDrawn);
}

TEST(FrameProof, FindsALoopOfFramesThatTookNoTime) {
  ScriptedPrepared prepared(
      [](int n) { return frame_of(n == warm_up + timed + 3 ? 0.02 * ms : 6 * ms); });
  EXPECT_THROW(measure_all(prepared), NotDrawn);
  const auto never = []() -> double { throw std::logic_error("no more frames are needed"); };
  EXPECT_NO_THROW(check_loop({0.9 * ms}, {6 * ms}, never));
  EXPECT_NO_THROW(check_loop({0.02 * ms}, {1.9 * ms}, never));
}

// On a busy machine, every checked frame may be slow until the machine is free again. Therefore
// more frames are drawn before an error is reported.
TEST(FrameProof, DrawsMoreFramesBeforeItReportsALoop) {
  int more = 0;
  EXPECT_NO_THROW(check_loop({0.3 * ms}, {6 * ms}, [&] { return ++more < 5 ? 6 * ms : 0.4 * ms; }));
  EXPECT_EQ(more, 5);
}

TEST(FrameProof, FramesAfterAJumpMayDifferButNotBeMissing) {
  const Protocol jumping{.timed = false, .camera_jumps = true};
  ScriptedPrepared differing = steady(50 * ms);
  differing.value_of_frame = [](int n) { return static_cast<float>(n); };
  EXPECT_NO_THROW(measure_all(differing, jumping));
  ScriptedPrepared missing = steady(50 * ms);
  missing.draws = [](int n) { return n == 1; };
  EXPECT_THROW(measure_all(missing, jumping), NotDrawn);
}

TEST(FrameProof, FindsAnImageThatIsNeverDrawn) {
  ScriptedPrepared prepared = steady(50 * ms);
  prepared.draws = [](int) { return false; };
  for (const bool is_timed : {true, false}) {
    EXPECT_THROW(measure_all(prepared, {.timed = is_timed}), NotDrawn) << is_timed;
  }
}

// If a frame computes NaNs, it did draw the image. Whether NaNs are correct is left to the
// comparison with the reference image.
TEST(FrameProof, AcceptsNaNsThatAFrameComputed) {
  // The NaN that an x86 CPU computes for 0/0.
  static constexpr std::uint32_t computed_nan = 0xFFC00000;
  ScriptedPrepared prepared = steady(50 * ms);
  prepared.value_of_frame = [](int) { return std::bit_cast<float>(computed_nan); };
  EXPECT_NO_THROW(measure_all(prepared));
  prepared.draws = [](int n) { return n == 1; };
  EXPECT_THROW(measure_all(prepared), NotDrawn);
}

TEST(FrameProof, FindsAnImageThatCannotBeOverwritten) {
  class Kept final : public Prepared {
   public:
    void poison() override {}
    Frame frame(Purpose) override { return frame_of(50 * ms); }
    core::Image image() override { return core::Image(2, 1); }
    std::string kernel_hash() const override { return "kernel"; }
  };
  Kept prepared;
  EXPECT_THAT([&] { measure_all(prepared); },
              testing::ThrowsMessage<NotDrawn>(testing::HasSubstr("could not be overwritten")));
}

TEST(FrameProof, DoesNotTrustClocksOfFramesThatAreNotDrawn) {
  ScriptedPrepared prepared = steady(50 * ms, 49 * ms);
  prepared.draws = [](int n) { return n < 3; };
  EXPECT_THROW(static_cast<void>(calibrate(prepared, technique::Work::compute)), NotDrawn);
}

TEST(FrameProof, CountersThatNothingWroteAreNotCounts) {
  EXPECT_THROW(check_counted(std::vector<std::uint32_t>(3, poison_word)), NotDrawn);
  EXPECT_NO_THROW(check_counted(std::vector<std::uint32_t>{poison_word, 0}));
  EXPECT_NO_THROW(check_counted({}));
}

}  // namespace
}  // namespace triptych::measure
