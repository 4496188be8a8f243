#include "report/screen/progress_log.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "support/well_formed.hpp"

namespace triptych::report {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;
using testing::Not;

class ProgressLogTest : public testing::Test {
 protected:
  ProgressLog log(std::size_t width = 0, bool verbose = false) {
    return ProgressLog({.width = width, .verbose = verbose, .now = [this] { return now; }});
  }

  record::Record record_of(int step, record::Outcome outcome = record::Outcome::measured) {
    record::Record record;
    record.suite = "volume";
    record.plan = "volume/quick";
    record.device = "gl:x";
    record.configuration = fmt::format("data=ball,step={},technique=raycast", step);
    record.outcome = outcome;
    if (outcome == record::Outcome::crashed) {
      record.reason = {.cause = record::Cause::signal, .numbers = {{"signal", 11}}};
    }
    return record;
  }

  std::string run(ProgressLog& log, int count, record::Outcome outcome, seconds each) {
    std::string text;
    for (int i = 1; i <= count; ++i) {
      now += each;
      const record::Record record = record_of(i, outcome);
      text += log.next({.plan = record.plan,
                        .device = record.device,
                        .done = i,
                        .total = count,
                        .left = seconds(count - i) * each.count(),
                        .record = &record});
    }
    return text + log.end();
  }

  ProgressLog::Clock::time_point now;
};

long lines_of(const std::string& text) {
  return std::ranges::count(text, '\n');
}

TEST_F(ProgressLogTest, APassingLogHasALineForEachDevice) {
  ProgressLog quiet = log();
  EXPECT_EQ(run(quiet, 20, record::Outcome::measured, seconds(1)),
            "volume/quick on gl:x: 20 measured, 0 skipped, 0 failed, 20 s\n");
}

TEST_F(ProgressLogTest, ItsLengthDoesNotGrowWithThePlan) {
  ProgressLog failing = log();
  // The simulated run takes 67 minutes, because each of the 2,000 configurations takes two seconds.
  const std::string text = run(failing, 2000, record::Outcome::crashed, seconds(2));
  EXPECT_LE(lines_of(text), 30) << text;
  EXPECT_THAT(text, HasSubstr("1/2000 gl:x volume.quick.raycast.ball.s1: crashed: "));
  EXPECT_THAT(text, HasSubstr("0 measured, 0 skipped, 2000 failed"));
  EXPECT_THAT(text, HasSubstr("volume/quick: 18 of 2000, about "));
}

TEST_F(ProgressLogTest, VerboseHasALineForEachConfiguration) {
  ProgressLog verbose = log(0, true);
  EXPECT_EQ(lines_of(run(verbose, 50, record::Outcome::measured, seconds(60))), 51);
}

TEST_F(ProgressLogTest, ATerminalHasOneLineThatFits) {
  ProgressLog bar = log(80);
  std::string text;
  const record::Record record = record_of(1);
  text = bar.next({.plan = record.plan,
                   .device = "vulkan:" + std::string(200, 'x'),
                   .done = 18,
                   .total = 36,
                   .left = seconds(200),
                   .record = &record});
  EXPECT_TRUE(text.starts_with("\r\033[Kvolume/quick [##########..........] 18/36 vulkan:x"));
  EXPECT_EQ(lines_of(text), 0);
  EXPECT_EQ(text.size() - std::string("\r\033[K").size(), 79U + std::string("…").size() - 1);
  EXPECT_THAT(bar.end(), HasSubstr("\r\033[Kvolume/quick on gl:x"));
}

TEST_F(ProgressLogTest, ABarShowsTheTimeLeft) {
  ProgressLog bar = log(80);
  const record::Record record = record_of(1);
  EXPECT_THAT(bar.next({.plan = record.plan,
                        .device = "gl:x",
                        .done = 1,
                        .total = 3,
                        .left = seconds(200),
                        .record = &record}),
              HasSubstr("1/3 gl:x, 4 min left"));
}

// The remaining time of a single plan would mislead if further plans follow.
TEST_F(ProgressLogTest, TheTimeLeftIsThatOfAllPlans) {
  const auto first_step = [this](ProgressLog& any) {
    now += seconds(40);
    const record::Record record = record_of(1);
    return any.next({.plan = record.plan,
                     .device = record.device,
                     .done = 1,
                     .total = 2,
                     .left = seconds(40),
                     .record = &record});
  };
  const std::vector<std::pair<std::string, int>> planned{{"volume/quick", 2}, {"volume/stress", 4}};
  for (const std::size_t width : {0U, 80U}) {
    ProgressLog one({.width = width, .now = [this] { return now; }, .planned = {planned.front()}});
    EXPECT_THAT(first_step(one), HasSubstr(" 40 s left"));
    ProgressLog both({.width = width, .now = [this] { return now; }, .planned = planned});
    EXPECT_THAT(first_step(both), HasSubstr(" 4 min left"));  // 5 configurations of 40 s
  }
}

TEST_F(ProgressLogTest, EscapesNames) {
  for (const std::string& name : test::hostile_strings()) {
    for (const std::size_t width : {0U, 80U}) {
      ProgressLog any = log(width, true);
      record::Record record = record_of(1);
      record.plan = record.device = record.configuration = name;
      std::string text = any.next({.plan = record.plan,
                                   .device = record.device,
                                   .done = 1,
                                   .total = 1,
                                   .record = &record}) +
                         any.end();
      for (std::size_t at = 0; (at = text.find("\r\033[K")) != std::string::npos;)
        text.erase(at, 4);
      EXPECT_EQ(text.find('\x1b'), std::string::npos);
      EXPECT_THAT(text, Not(HasSubstr("line\nend")));
    }
  }
}

TEST_F(ProgressLogTest, ALongImageHasABarOrSparseLines) {
  for (const std::size_t width : {0U, 80U}) {
    ShareLog log({.width = width, .now = [this] { return now; }});
    std::string text = log.next("computing", 0);
    for (int second = 1; second <= 100; ++second) {
      now += seconds(1);
      text += log.next("computing", second / 100.0);
    }
    if (width == 0) {
      // After 10, 20, 40 and 80 seconds.
      EXPECT_EQ(lines_of(text), 4) << text;
      EXPECT_TRUE(text.starts_with("computing: 10 %, about 91 s left\n")) << text;
    } else {
      EXPECT_EQ(lines_of(text), 0) << text;
      EXPECT_THAT(text, HasSubstr("\r\033[Kcomputing [##########..........] 50 %, 51 s left"));
      EXPECT_TRUE(text.ends_with("\r\033[K"));
    }
  }
}

TEST_F(ProgressLogTest, AShortImageIsNotReported) {
  for (const std::size_t width : {0U, 80U}) {
    ShareLog log({.width = width, .now = [this] { return now; }});
    for (int image = 0; image < 100; ++image) {
      EXPECT_EQ(log.next("computing", 0), "");
      now += std::chrono::milliseconds(500);
      EXPECT_EQ(log.next("computing", 0.5), "");
      EXPECT_EQ(log.next("computing", 1), "");
    }
  }
}

TEST(RoughTime, IsRoundedUp) {
  EXPECT_EQ(rounded_duration(seconds(119)), "119 s");
  EXPECT_EQ(rounded_duration(seconds(121)), "3 min");
  EXPECT_EQ(rounded_duration(seconds(7201)), "3 h");
}

}  // namespace
}  // namespace triptych::report
