// Tests that configurations are selected by their short names, with the same options in every
// command.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"

namespace triptych::command_line {
namespace {

using testing::HasSubstr;

std::vector<std::string> names_in(const std::string& listed) {
  std::vector<std::string> names;
  std::istringstream lines(listed);
  for (std::string line; std::getline(lines, line);) {
    if (const auto end = line.find("  "); end != std::string::npos) {
      names.push_back(line.substr(0, end));
    }
  }
  return names;
}

// A short name can select a configuration only if no other configuration has the same short name.
TEST(ShortNames, AreUniqueInEveryPlanThatComesWithTriptych) {
  const Program program;
  for (const char* plan :
       {"volume/quick", "volume/cost", "volume/stress", "volume/accuracy", "volume/real",
        "volume/code", "particles/quick", "particles/cost", "particles/stress",
        "particles/accuracy", "particles/real", "particles/code"}) {
    const Result listed = program.run(std::string("list ") + plan);
    ASSERT_EQ(listed.code, 0) << listed.output;
    const std::vector<std::string> names = names_in(listed.output);
    ASSERT_FALSE(names.empty()) << plan;
    const std::set<std::string> different(names.begin(), names.end());
    EXPECT_EQ(different.size(), names.size()) << plan;
  }
}

constexpr const char* four =
    " --set technique=raycast --set data=generate:gaussian_blob:16 --set viewport=16 "
    "--set transfer_function=haze,surfaces --set step=1,2";

class Selected : public testing::TestWithParam<const char*> {};

// The same option must select the same configurations for listing, measuring and judging.
TEST_P(Selected, InListRunGateAndCompare) {
  const Program program;
  program.write("cases",
                "volume.quick.raycast.gaussian_blob_16.surfaces.orbit_y_1_8.v16\n"
                "volume.quick.raycast.gaussian_blob_16.surfaces.orbit_y_1_8.s2.v16\n");
  const std::string chosen = std::string(four) + " " + GetParam();
  EXPECT_EQ(names_in(program.run("list volume/quick" + chosen).output).size(), 2U);
  const Result measured =
      program.run("run volume/quick --device 'null:*' --store s.sqlite" + chosen);
  EXPECT_THAT(measured.output, HasSubstr("2 measured, 0 skipped, 0 failed"));
  const std::string judge = "gate volume/quick --check counters --baselines b --store s.sqlite";
  ASSERT_EQ(program.run("accept --reason new --baselines b --store s.sqlite").code, 0);
  const Result judged = program.run(judge + chosen);
  EXPECT_EQ(judged.code, 0) << judged.output;
  EXPECT_THAT(judged.output, HasSubstr("only part of the plans"));
  const Result compared =
      program.run("compare volume/quick --no-times --a null:scripted --b null:scripted" + chosen);
  // The scripted device draws a pattern, so every image is wrong.
  EXPECT_THAT(compared.output, HasSubstr("image: in 2 configurations; largest change in "));
}

std::string option_name(const testing::TestParamInfo<const char*>& info) {
  return std::array{"filter", "caselist", "fraction"}.at(info.index);
}

INSTANTIATE_TEST_SUITE_P(Options, Selected,
                         testing::Values("--filter '*.surfaces.*'", "--caselist cases",
                                         "--fraction 1/2"),
                         option_name);

TEST(Selection, AnEmptySelectionIsAnError) {
  const Program program;
  for (const char* command : {"list volume/quick", "run volume/quick", "gate --measure",
                              "compare --a null:scripted --b null:scripted"}) {
    const Result refused = program.run(std::string(command) + " --filter 'volume.quik.*'");
    EXPECT_EQ(refused.code, 3) << command;
    EXPECT_THAT(refused.output, HasSubstr("--filter volume.quik.*: no configuration matches"));
  }
}

}  // namespace
}  // namespace triptych::command_line
