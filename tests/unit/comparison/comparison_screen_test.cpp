#include "report/screen/comparison_screen.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "report/exports/comparison_json.hpp"

namespace triptych::report {
namespace {

using comparison::ComparedConfiguration;
using comparison::ComparisonResult;
using comparison::ConfigurationDiff;
using comparison::StoreDiff;
using comparison::TimeCause;

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

record::Device device(std::string id, std::map<std::string, std::string> environment = {}) {
  return {.id = std::move(id),
          .driver_version = "Mesa 1",
          .api_version = "1.3",
          .cpu_features = "avx avx2",
          .environment = std::move(environment)};
}

comparison::TimeReason no_compute_shaders() {
  return {.cause = TimeCause::side_ended,
          .side = measure::Side::b,
          .outcome = record::Outcome::skipped,
          .reason = {.cause = record::Cause::not_supported, .detail = "no compute shaders"}};
}

std::string sides_of(const record::Device& a, const record::Device& b) {
  ComparisonResult result;
  result.a = a;
  result.b = b;
  return screen_of(result, {.plan = "volume/quick", .sides = "", .varied = {}});
}

TEST(ComparisonScreen, PrintsCommonInformationOnce) {
  const record::Device plain = device("vulkan:x");
  EXPECT_THAT(sides_of(plain, plain),
              HasSubstr("a: vulkan:x; driver Mesa 1; API 1.3\nb: the same\n"));
  EXPECT_THAT(sides_of(plain, device("gl:y")), HasSubstr("b: gl:y; driver Mesa 1; API 1.3\n"));
  record::Device other = plain;
  other.cpu_features = "avx";
  EXPECT_THAT(sides_of(plain, other),
              HasSubstr("API 1.3; CPU avx avx2\nb: the same, but CPU avx\n"));
}

TEST(ComparisonScreen, ShowsTheVariablesOfASide) {
  const record::Device plain = device("vulkan:x");
  const record::Device one = device("vulkan:x", {{"WIDTH", "128"}});
  EXPECT_THAT(sides_of(plain, one), HasSubstr("b: the same, but WIDTH=128\n"));
  EXPECT_THAT(sides_of(one, plain),
              HasSubstr("API 1.3; WIDTH=128\nb: the same, but without WIDTH=128\n"));
  EXPECT_THAT(sides_of(one, device("vulkan:x", {{"WIDTH", "256"}})),
              HasSubstr("WIDTH=128\nb: the same, but WIDTH=256\n"));
}

// Neither of the two compared devices supports the only configuration.
TEST(ComparisonScreen, ExplainsWhyNothingWasCompared) {
  ComparisonResult result;
  ComparedConfiguration skipped;
  skipped.ended = record::Outcome::skipped;
  skipped.reason = no_compute_shaders();
  result.configurations = {skipped};
  EXPECT_EQ(result.exit_code(), core::ExitCode::cannot_judge);
  EXPECT_THAT(screen_of(result, {.plan = "volume/quick", .sides = "", .varied = {}}),
              AllOf(HasSubstr("nothing was compared: no configuration was measured on both sides; "
                              "side b skipped: no compute shaders\n"),
                    Not(HasSubstr("no differences"))));
}

// Without a measured time, the estimated shift between the times of the two sides is 0. The screen
// must not relate this 0 to the change of work.
TEST(ComparisonScreen, HasNoTimePerWorkWithoutAMeasuredTime) {
  ComparisonResult result;
  result.timed = true;
  ComparedConfiguration wrong;
  wrong.reason = {.cause = TimeCause::wrong_image, .side = measure::Side::b};
  wrong.work = judge::WorkChange{.log_ratio = std::log(1.167), .unit = "samples"};
  result.configurations = {wrong};
  const ComparisonCommand command{.plan = "volume/quick", .sides = "", .varied = {}};
  EXPECT_THAT(screen_of(result, command),
              AllOf(HasSubstr("+16.70 % samples\n"), Not(HasSubstr("time per unit"))));
  const auto work_in = [&] { return to_json(result, command)["configurations"][0]["work"]; };
  EXPECT_FALSE(work_in().contains("ln_time_per_work"));
  result.configurations[0].blocks = 12;
  result.configurations[0].shift.estimate = std::log(1.2);
  EXPECT_THAT(screen_of(result, command),
              HasSubstr("+16.70 % samples, +2.83 % time per unit of work\n"));
  EXPECT_NEAR(work_in().at("ln_time_per_work"), std::log(1.2 / 1.167), 1e-12);
  result.configurations[0].ended = record::Outcome::crashed;
  EXPECT_THAT(screen_of(result, command), Not(HasSubstr("time per unit")));
  EXPECT_FALSE(work_in().contains("ln_time_per_work"));
}

TEST(ComparisonScreen, StoresThatMeasuredNothingDoNotPass) {
  ConfigurationDiff skipped;
  skipped.ended = record::Outcome::skipped;
  skipped.no_time = no_compute_shaders();
  StoreDiff diff;
  diff.devices.push_back(
      {.a = device("gl:x"), .b = device("gl:x"), .device = {}, .configurations = {skipped}});
  EXPECT_EQ(diff.exit_code(), core::ExitCode::cannot_judge);
  EXPECT_THAT(screen_of(diff),
              HasSubstr("nothing was compared: no configuration was measured on both "
                        "sides; side b skipped: no compute shaders\n"));
  diff.devices.front().configurations.push_back({});
  EXPECT_EQ(diff.exit_code(), core::ExitCode::pass);
  EXPECT_THAT(screen_of(diff), HasSubstr("no differences"));
}

}  // namespace
}  // namespace triptych::report
