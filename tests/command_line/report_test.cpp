// Tests the HTML pages, created from runs on scripted devices.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "correct_image.hpp"
#include "program.hpp"
#include "support/well_formed.hpp"

namespace triptych::command_line {
namespace {

using testing::HasSubstr;

class ReportTest : public testing::Test {
 protected:
  void measure(const std::string& plan_and_factors) const {
    const Result result = program_.run(
        "run " + plan_and_factors + " --device 'null:*' --store s.sqlite",
        R"({"devices": [1, 1.7], "base_ns": 1e6, "ns_per_sample": 50, "noise": 0.002})");
    ASSERT_EQ(result.code, 0) << result.output;
  }
  [[nodiscard]] std::string report(const std::string& more = {}) const {
    const Result result =
        program_.run("report --store s.sqlite --baselines b --out page.html " + more);
    EXPECT_EQ(result.code, 0) << result.output;
    return program_.read("page.html");
  }

  Program program_;
};

constexpr const char* small_scene = " --set data=generate:gaussian_blob:16 --set viewport=16";

TEST_F(ReportTest, EveryChartIsDrawn) {
  measure(std::string("volume/quick") + small_scene);
  measure(std::string("volume/accuracy") + small_scene);
  const std::string page = report();
  EXPECT_THAT(page, HasSubstr("RMSE against the limit"));
  EXPECT_THAT(page, HasSubstr("frame time, ms"));
  for (auto at = page.find("<svg class=\"figure\""); at != std::string::npos;
       at = page.find("<svg class=\"figure\"", at + 1)) {
    // The marks are inside a nested SVG element, so the figure ends at the second </svg>.
    const auto marks = page.find("</svg>", at) + 1;
    const std::string figure = page.substr(at, page.find("</svg>", marks) + 6 - at);
    EXPECT_EQ(test::xml_fault(figure), "");
    EXPECT_EQ(figure.find("nan"), std::string::npos);
  }
}

// A plan without baselines is an exploration. The page does not present it as a failure unless an
// image is wrong.
TEST_F(ReportTest, WithoutBaselinesBeginsWithResults) {
  const std::string run = std::string("run volume/quick --untimed --store s.sqlite ") + tiny;
  const std::string right = R"({"images": {"*": ")" + correct_image(program_).string() + R"("}})";
  ASSERT_EQ(program_.run(run, right).code, 0);
  EXPECT_THAT(report(), HasSubstr("<h1>Results without baselines (2)</h1>"));
  ASSERT_EQ(program_.run(run).code, 0);
  EXPECT_THAT(report(), HasSubstr("<h1>FAIL (1)</h1>"));
}

TEST_F(ReportTest, NeedsNoNetwork) {
  measure(std::string("volume/quick") + small_scene);
  const std::string page = report();
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_THAT(page, HasSubstr("null:scripted"));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
}

TEST_F(ReportTest, BeginsWithVerdictThenImagesThenPlans) {
  measure(std::string("volume/quick") + small_scene);
  measure(std::string("volume/speed") + small_scene);
  const std::string page = report();
  const auto header = page.find("<header id=\"verdict\"");
  EXPECT_LT(header, page.find("<a href=\"#plan0\">volume/quick</a>"));
  EXPECT_LT(header, page.find("<th scope=\"row\">Images</th>"));
  EXPECT_LT(page.find("<th scope=\"row\">Images</th>"), page.find("<h2 id=\"images\">"));
  EXPECT_LT(page.find("<h2 id=\"images\">"), page.find("<section id=\"plan0\">"));
}

TEST_F(ReportTest, OutputsWithTheSameNameAreRejected) {
  measure(std::string("volume/quick --untimed") + small_scene);
  const std::string store = program_.read("s.sqlite");
  const Result over_store = program_.run("report --store s.sqlite --out ./s.sqlite");
  EXPECT_EQ(over_store.code, 3);
  EXPECT_THAT(over_store.output, HasSubstr("--out ./s.sqlite names the same file as --store"));
  EXPECT_EQ(program_.read("s.sqlite"), store);
  const Result over_page = program_.run("report --store s.sqlite --out x --benchmark-json x");
  EXPECT_EQ(over_page.code, 3);
  EXPECT_THAT(over_page.output, HasSubstr("--benchmark-json x names the same file as --out"));
}

TEST_F(ReportTest, WritesBothFilesOrNeither) {
  measure(std::string("volume/quick --untimed") + small_scene);
  std::filesystem::create_directory(program_.folder() / "folder");
  const std::string command = "report --store s.sqlite --baselines b --out page.html ";
  const Result refused = program_.run(command + "--benchmark-json folder");
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.output, HasSubstr("--benchmark-json folder is a folder; name a file in it"));
  EXPECT_FALSE(std::filesystem::exists(program_.folder() / "page.html"));
  EXPECT_EQ(program_.run(command + "--benchmark-json b.json").output, "page.html\nb.json\n");
}

// The benchmark file must contain all plans of the store, not only one.
TEST_F(ReportTest, BenchmarkJsonContainsEveryPlan) {
  measure(std::string("volume/quick") + small_scene);
  measure(std::string("volume/speed") + small_scene);
  static_cast<void>(report("--benchmark-json benchmark.json"));
  const auto json = nlohmann::json::parse(program_.read("benchmark.json"));
  EXPECT_TRUE(json.at("context").contains("device null:scripted"));
  std::set<std::string> plans;
  for (const auto& entry : json.at("benchmarks")) {
    const auto plan = entry.at("plan").get<std::string>();
    plans.insert(plan);
    EXPECT_THAT(entry.at("run_name").get<std::string>(),
                testing::StartsWith(plan + "/null:scripted"));
    EXPECT_THAT(entry.at("name").get<std::string>(),
                testing::StartsWith(entry.at("run_name").get<std::string>()));
  }
  EXPECT_EQ(plans, (std::set<std::string>{"volume/quick", "volume/speed"}));
}

}  // namespace
}  // namespace triptych::command_line
