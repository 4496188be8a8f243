// Tests devices that only compile, which means that a driver compiles code for a GPU that this
// machine does not have. Uses RADV if it is installed. Tests a worker process, a plan and the gate.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "core/json.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

using testing::AllOf;
using testing::Ge;
using testing::Le;

// The oldest supported Mesa release already knows this GPU family.
constexpr const char* absent_device = "vulkan:radv-navi21";

class OnlyCompile : public testing::Test {
 protected:
  void SetUp() override {
    program.write("drawn.yaml",
                  "suite: volume\ntechnique: [raycast, raycast_fragment]\n"
                  "data: [generate:gaussian_blob:8]\nviewport: [16]\n");
    program.write("compiled.yaml",
                  "suite: volume\nchecks: [code]\ntechnique: [raycast, raycast_fragment]\n"
                  "data: [generate:sparse_field:8]\nviewport: [16]\n");
    if (!has_device()) GTEST_SKIP() << "RADV is not installed";
  }

  // `triptych devices` would calibrate every device, so this starts a run instead.
  [[nodiscard]] bool has_device() const {
    return program
               .run(std::string("run compiled.yaml --store probe.sqlite --device ") + absent_device)
               .output.find("no device matches") == std::string::npos;
  }

  [[nodiscard]] Result on(const std::string& command) const {
    return program.run(command + " --device " + absent_device + " --store s.sqlite");
  }

  Program program;
};

// On a device that only compiles, images would be black and times meaningless.
TEST_F(OnlyCompile, DrawsNothing) {
  const Result result = on("run drawn.yaml --verbose");
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_NE(result.output.find("0 measured"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("only compiles code and cannot draw"), std::string::npos)
      << result.output;
}

TEST_F(OnlyCompile, IsJudgedByItsCode) {
  ASSERT_EQ(on("run compiled.yaml").code, 0);
  ASSERT_EQ(program.run("accept compiled.yaml --reason new --baselines b --store s.sqlite").code,
            0);
  const Result same = on("run compiled.yaml");
  ASSERT_EQ(same.code, 0) << same.output;
  const Result passed = program.run("gate compiled.yaml --baselines b --store s.sqlite");
  EXPECT_EQ(passed.code, 0) << passed.output;

  // The command of a finding prints the stored statistics next to the new ones.
  const std::string code = std::string("code volume --device ") + absent_device +
                           " --set technique=raycast --set data=generate:sparse_field:8 --set "
                           "viewport=16 --json --brief --stored compiled --baselines b";
  const core::Json equal = core::Json::parse(program.run(code).output);
  EXPECT_EQ(equal.at("stored").at("raycast.comp").at("statistics"),
            equal.at("code").at("raycast.comp").at("statistics"));
  const core::Json injected =
      core::Json::parse(program.run(code + " --inject flipped_axis").output);
  EXPECT_EQ(injected.at("stored"), equal.at("stored"));
  EXPECT_NE(injected.at("stored").at("raycast.comp").at("statistics"),
            injected.at("code").at("raycast.comp").at("statistics"));
}

TEST_F(OnlyCompile, PrintsStatisticsAndDisassembly) {
  const Result result =
      program.run(std::string("code volume --device ") + absent_device + " --set sampler=hardware");
  EXPECT_EQ(result.code, 0) << result.output;
  for (const char* part : {"raycast.comp", "Inverse Throughput", "Loop instructions", "s_endpgm"}) {
    EXPECT_NE(result.output.find(part), std::string::npos) << part << " in " << result.output;
  }
}

TEST_F(OnlyCompile, AnUnknownFamilyIsReportedInOneLine) {
  const Result result =
      program.run("run compiled.yaml --device vulkan:radv-nosuch --store s.sqlite");
  EXPECT_EQ(result.code, 2) << result.output;
  // The single line names the requested family and the reason why it is unavailable.
  EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
  EXPECT_EQ(result.output.find("triptych: no device matches vulkan:radv-nosuch"), 0U)
      << result.output;
  EXPECT_NE(result.output.find("vulkan:radv-nosuch: the installed driver"), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("not support this GPU family"), std::string::npos) << result.output;
  // It also names the families that can be used.
  EXPECT_NE(result.output.find(absent_device), std::string::npos) << result.output;
}

// Every listed compiler accepts its GPU family.
TEST_F(OnlyCompile, DevicesListsOnlyFamiliesThatTheDriverSupports) {
  const core::Json listed =
      core::Json::parse(program.run("devices --json --device 'null:*'").output);
  std::set<std::string> compilers = listed.at("compilers");
  EXPECT_TRUE(compilers.contains(absent_device)) << listed;
  for (const std::string& id : compilers) {
    EXPECT_EQ(program.run("code volume --brief --device " + id).code, 0) << id;
  }
}

// The fault `flipped_axis` adds one arithmetic operation to each sample of a ray, and
// `unresolved_ties` adds two operations to each sphere of a tile.
TEST_F(OnlyCompile, AnInjectedFaultIsFoundOnEveryFamily) {
  program.write("rays.yaml",
                "suite: volume\nchecks: [code]\ntechnique: [raycast]\nsampler: [hardware]\n"
                "data: [generate:sparse_field:8]\nviewport: [16]\n");
  program.write("tiles.yaml",
                "suite: particles\nchecks: [code]\ntechnique: [tiles]\n"
                "data: [generate:uniform:50]\nviewport: [16]\n");
  const std::string all = " --device 'vulkan:radv-*' --store s.sqlite";
  ASSERT_EQ(program.run("run rays.yaml tiles.yaml" + all).code, 0);
  ASSERT_EQ(
      program.run("accept rays.yaml tiles.yaml --reason new --baselines b --store s.sqlite").code,
      0);
  std::filesystem::copy_file(program.folder() / "s.sqlite", program.folder() / "before.sqlite");
  ASSERT_EQ(program.run("run rays.yaml --inject flipped_axis" + all).code, 0);
  ASSERT_EQ(program.run("run tiles.yaml --inject unresolved_ties" + all).code, 0);
  const Result judged =
      program.run("gate rays.yaml tiles.yaml --baselines b --store s.sqlite --json");
  EXPECT_EQ(judged.code, 1) << judged.output;

  std::map<std::string, std::map<std::string, double>> grown;  // increase by device and statistic
  for (const core::Json& plan : core::Json::parse(judged.output)) {
    for (const core::Json& finding : plan.at("findings")) {
      EXPECT_EQ(finding.at("cause"), "values_changed");
      EXPECT_EQ(finding.at("verdict"), "regression");
      for (const core::Json& change : finding.at("changes")) {
        grown[finding.at("device")][change.at("name")] =
            change.at("now").get<double>() - change.at("before").get<double>();
      }
    }
  }
  EXPECT_GE(grown.size(), 3U) << judged.output;
  // A compiler may merge an added operation with a neighbouring one, or add another instruction
  // that moves a value.
  for (auto& [device, changes] : grown) {
    EXPECT_THAT(changes["instructions per iteration"], AllOf(Ge(1), Le(2))) << device;
    EXPECT_THAT(changes["tiles_index.comp instructions per iteration"], AllOf(Ge(1), Le(2)))
        << device;
  }
  // The totals of each plan are listed separately.
  std::set<std::string> totals;
  const Result diff = program.run("diff before.sqlite s.sqlite --json");
  const core::Json differences = core::Json::parse(diff.output);
  for (const core::Json& device : differences.at("devices")) {
    for (const core::Json& each : device.at("differences")) {
      if (each.at("cause") == "code_total") totals.insert(each.at("about"));
    }
  }
  EXPECT_TRUE(totals.contains("code total rays Instrs")) << diff.output;
  EXPECT_TRUE(totals.contains("code total tiles Instrs")) << diff.output;
}

// The verdict states why a required family was not measured.
TEST_F(OnlyCompile, ARequiredFamilyThatCannotBeUsedIsNotAPass) {
  ASSERT_EQ(on("run compiled.yaml").code, 0);
  ASSERT_EQ(program.run("accept compiled.yaml --reason new --baselines b --store s.sqlite").code,
            0);
  const std::string required = " --baselines b --require vulkan:radv-nosuch";
  const Result measured = on("gate compiled.yaml --measure" + required);
  EXPECT_EQ(measured.code, 2) << measured.output;
  const Result judged = on("gate compiled.yaml --json" + required);
  EXPECT_EQ(judged.code, 2) << judged.output;
  std::vector<core::Json> found;
  const core::Json result = core::Json::parse(judged.output);
  for (const core::Json& finding : result.at("findings")) {
    if (finding.at("cause") == "no_required_device") found.push_back(finding);
  }
  ASSERT_EQ(found.size(), 1U) << judged.output;
  EXPECT_EQ(found.front().at("facts").at("glob"), "vulkan:radv-nosuch");
  EXPECT_FALSE(found.front().at("detail").get<std::string>().empty()) << judged.output;
}

// Without code statistics in the baselines, there is nothing to judge, so nothing is compiled.
TEST_F(OnlyCompile, NothingIsCompiledWithoutStoredCode) {
  const std::string gate =
      std::string("gate --check code --measure --baselines none --store s.sqlite --device ") +
      absent_device;
  const Result result = program.run(gate);
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_NE(result.output.find("there is nothing to judge"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace triptych::command_line
