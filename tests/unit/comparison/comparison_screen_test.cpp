#include "report/screen/comparison_screen.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <sstream>

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

TEST(ComparisonScreen, NamesDriverAndVersionOfBothSides) {
  const record::Device plain = device("vulkan:x");
  EXPECT_THAT(
      sides_of(plain, plain),
      HasSubstr("\na: vulkan:x; driver Mesa 1; API 1.3\nb: vulkan:x; driver Mesa 1; API 1.3\n"));
  record::Device other = plain;
  other.driver = "lavapipe";
  other.cpu_features = "avx";
  EXPECT_THAT(sides_of(plain, other),
              AllOf(HasSubstr("API 1.3\n              CPU avx avx2\nb: vulkan:x; driver lavapipe, "
                              "Mesa 1; API 1.3\n              CPU avx\n")));
}

TEST(ComparisonScreen, ShowsTheVariablesAndProgramsOfBothSides) {
  ComparisonResult result;
  result.a = device("vulkan:x", {{"WIDTH", "128"}});
  result.b = device("vulkan:x");
  result.environment = {{{"WIDTH=128", "LD_LIBRARY_PATH=/next"}, {}}};
  result.programs = {"/old/triptych", "/new/triptych"};
  EXPECT_THAT(screen_of(result, {.plan = "volume/quick", .sides = "", .varied = {}, .base = true}),
              HasSubstr("a (--base): vulkan:x; driver Mesa 1; API 1.3\n"
                        "              program /old/triptych\n"
                        "              WIDTH=128\n"
                        "              LD_LIBRARY_PATH=/next\n"
                        "b (tested): vulkan:x; driver Mesa 1; API 1.3\n"
                        "              program /new/triptych\n"));
}

// Returns a configuration whose time was measured in a number of blocks.
ComparedConfiguration timed(const std::string& key, comparison::PairVerdict verdict,
                            comparison::Shift shift) {
  ComparedConfiguration compared;
  compared.key = key;
  compared.verdict = verdict;
  compared.shift = shift;
  compared.blocks = 384;
  if (verdict == comparison::PairVerdict::undecided) {
    compared.reason = {.cause = TimeCause::undecided, .numbers = {{"blocks", 384}}};
  }
  return compared;
}

// The geometric mean of the ratios and of the ends of their intervals.
TEST(ComparisonScreen, SummarizesTheTimesOfAllConfigurations) {
  using enum comparison::PairVerdict;
  ComparisonResult result;
  result.timed = true;
  result.configurations = {timed("step=1", same, {0.01, {-0.01, 0.03}}),
                           timed("step=2", undecided, {0.03, {-0.05, 0.11}})};
  ASSERT_TRUE(result.overall_time());
  EXPECT_NEAR(result.overall_time()->shift.estimate, 0.02, 1e-12);
  EXPECT_NEAR(result.overall_time()->shift.interval.low, -0.03, 1e-12);
  EXPECT_NEAR(result.overall_time()->shift.interval.high, 0.07, 1e-12);
  EXPECT_EQ(result.overall_time()->decided, 1);
  EXPECT_EQ(result.overall_time()->undecided, 1);
  result.other_load = 4.6;
  const core::Json json = to_json(result, {.plan = "volume/quick", .sides = "", .varied = {}});
  EXPECT_NEAR(json.at("overall").at("ratio"), std::exp(0.02), 1e-12);
  EXPECT_EQ(json.at("other_load"), 4.6);
  result.configurations[0].shift.interval.high = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(result.overall_time());
}

TEST(ComparisonScreen, FoldsUndecidedConfigurationsUnlessVerbose) {
  ComparisonResult result;
  result.timed = true;
  for (int i = 0; i < 9; ++i) {
    result.configurations.push_back(
        timed(fmt::format("step={}", i), comparison::PairVerdict::undecided, {0.01, {-0.1, 0.1}}));
  }
  ComparisonCommand command{.plan = "volume/quick", .sides = "", .varied = {}};
  const std::string folded = screen_of(result, command);
  EXPECT_THAT(folded, AllOf(HasSubstr("s2\n"), Not(HasSubstr("s3\n")), HasSubstr("6 more; ")));
  EXPECT_EQ(to_json(result, command).at("configurations").size(), 9U);
  command.verbose = true;
  EXPECT_THAT(screen_of(result, command), AllOf(HasSubstr("s8\n"), Not(HasSubstr("more; "))));
}

TEST(ComparisonScreen, NoLineIsWiderThanTwoHundredCharacters) {
  ComparisonResult result;
  result.timed = true;
  result.configurations = {timed(std::string("data=") + std::string(120, 'x'),
                                 comparison::PairVerdict::undecided, {0.01, {-0.1, 0.1}})};
  result.configurations[0].times = {{{1e6, 2e6, 3e6, 4e6, 5e6}, {1e6, 2e6, 3e6, 4e6, 5e6}}};
  result.configurations[0].differences = {
      {.kind = comparison::DifferenceKind::regression,
       .subject = comparison::Subject::image,
       .cause = comparison::DifferenceCause::other_bits,
       .numbers = {{"pixels", 1}, {"total", 4}, {"error", 1}, {"x", 0}, {"y", 0}, {"rmse", 1}}}};
  std::istringstream lines(screen_of(result, {.plan = "volume/quick", .sides = "", .varied = {}}));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 210U) << line;
}

// A command that measures again is printed only if the budget ended too early. Otherwise, it would
// be the same command again.
TEST(ComparisonScreen, SuggestsAnotherMeasurementOnlyIfItIsLonger) {
  ComparisonResult result;
  result.timed = true;
  result.configurations = {
      timed("step=1", comparison::PairVerdict::undecided, {0.01, {-0.1, 0.1}})};
  const ComparisonCommand command{.plan = "volume/quick",
                                  .sides = "--a gl:x --b gl:y",
                                  .varied = {},
                                  .exact_plan = "volume/cost"};
  EXPECT_THAT(screen_of(result, command),
              AllOf(HasSubstr("triptych compare volume/cost --a gl:x --b gl:y\n"),
                    Not(HasSubstr("triptych compare volume/quick"))));
  EXPECT_FALSE(to_json(result, command).at("configurations").at(0).contains("settle"));
  result.configurations[0].out_of_budget = true;
  EXPECT_THAT(screen_of(result, command),
              AllOf(HasSubstr("triptych compare volume/quick --a gl:x --b gl:y\n"),
                    Not(HasSubstr("volume/cost"))));
  EXPECT_TRUE(to_json(result, command).at("configurations").at(0).contains("settle"));
}

TEST(ComparisonScreen, WarnsIfADriverWasComparedWithItself) {
  ComparisonResult result;
  result.a = result.b = device("vulkan:x");
  const ComparisonCommand command{.plan = "volume/quick", .sides = "", .varied = {}};
  EXPECT_THAT(screen_of(result, command), Not(HasSubstr("!")));
  result.ineffective_variables = {"VK_DRIVER_FILES"};
  EXPECT_THAT(screen_of(result, command), HasSubstr("\n! Both sides loaded the same driver"));
  EXPECT_EQ(to_json(result, command).at("ineffective_variables").at(0), "VK_DRIVER_FILES");
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
