#include "comparison/text.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "comparison/store_diff.hpp"
#include "core/json.hpp"

namespace triptych::comparison {
namespace {

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

std::string sides_of(const record::Device& a, const record::Device& b) {
  ComparisonResult result;
  result.a = a;
  result.b = b;
  return to_text(result, {.plan = "volume/quick", .sides = "", .varied = {}});
}

TEST(ComparisonText, TellsOnceWhatBothSidesHave) {
  const record::Device plain = device("vulkan:x");
  EXPECT_THAT(sides_of(plain, plain),
              HasSubstr("a: vulkan:x; driver Mesa 1; API 1.3\nb: the same\n"));
  EXPECT_THAT(sides_of(plain, device("gl:y")), HasSubstr("b: gl:y; driver Mesa 1; API 1.3\n"));
  record::Device other = plain;
  other.cpu_features = "avx";
  EXPECT_THAT(sides_of(plain, other),
              HasSubstr("API 1.3; CPU avx avx2\nb: the same, but CPU avx\n"));
}

TEST(ComparisonText, NamesTheVariablesOfASide) {
  const record::Device plain = device("vulkan:x");
  const record::Device one = device("vulkan:x", {{"WIDTH", "128"}});
  EXPECT_THAT(sides_of(plain, one), HasSubstr("b: the same, but WIDTH=128\n"));
  EXPECT_THAT(sides_of(one, plain),
              HasSubstr("API 1.3; WIDTH=128\nb: the same, but without WIDTH=128\n"));
  EXPECT_THAT(sides_of(one, device("vulkan:x", {{"WIDTH", "256"}})),
              HasSubstr("WIDTH=128\nb: the same, but WIDTH=256\n"));
}

// One configuration, which neither side supports.
TEST(ComparisonText, SaysWhyNothingWasCompared) {
  ComparisonResult result;
  Compared skipped;
  skipped.ended = record::Outcome::skipped;
  skipped.reason = "b skipped: no compute shaders";
  result.configurations = {skipped};
  EXPECT_EQ(result.exit_code(), core::ExitCode::cannot_judge);
  EXPECT_THAT(to_text(result, {.plan = "volume/quick", .sides = "", .varied = {}}),
              AllOf(HasSubstr("nothing was compared: no configuration was measured on both sides; "
                              "b skipped: no compute shaders\n"),
                    Not(HasSubstr("nothing differs"))));
}

// Its shift is 0 because nobody measured it, so it must not be divided by the work.
TEST(ComparisonText, TellsNoTimePerWorkWhereNoTimeWasTaken) {
  ComparisonResult result;
  result.timed = true;
  Compared wrong;
  wrong.reason = "the picture of b is wrong, so its time means nothing";
  wrong.work = judge::WorkChange{.log_ratio = std::log(1.167), .unit = "samples"};
  result.configurations = {wrong};
  const ComparisonCommand command{.plan = "volume/quick", .sides = "", .varied = {}};
  EXPECT_THAT(to_text(result, command),
              AllOf(HasSubstr("+16.70 % samples\n"), Not(HasSubstr("time for each"))));
  const auto work_in = [&] { return to_json(result, command)["configurations"][0]["work"]; };
  EXPECT_FALSE(work_in().contains("ln_time_per_work"));
  result.configurations[0].blocks = 12;
  result.configurations[0].shift.estimate = std::log(1.2);
  EXPECT_THAT(to_text(result, command), HasSubstr("+16.70 % samples, +2.83 % time for each\n"));
  EXPECT_NEAR(work_in().at("ln_time_per_work"), std::log(1.2 / 1.167), 1e-12);
  result.configurations[0].ended = record::Outcome::crashed;
  EXPECT_THAT(to_text(result, command), Not(HasSubstr("time for each")));
  EXPECT_FALSE(work_in().contains("ln_time_per_work"));
}

TEST(StoreDiff, OfWhatNeitherStoreMeasuredIsNoPass) {
  ConfigurationDiff skipped;
  skipped.ended = record::Outcome::skipped;
  skipped.void_time = "b skipped: no compute shaders";
  StoreDiff diff;
  diff.devices.push_back(
      {.a = device("gl:x"), .b = device("gl:x"), .device = {}, .configurations = {skipped}});
  EXPECT_EQ(diff.exit_code(), core::ExitCode::cannot_judge);
  EXPECT_THAT(to_text(diff),
              HasSubstr("nothing was compared: no configuration was measured on both "
                        "sides; b skipped: no compute shaders\n"));
  diff.devices.front().configurations.push_back({});
  EXPECT_EQ(diff.exit_code(), core::ExitCode::pass);
  EXPECT_THAT(to_text(diff), HasSubstr("nothing differs"));
}

}  // namespace
}  // namespace triptych::comparison
