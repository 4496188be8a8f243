#include <fmt/format.h>
#include <gmock/gmock.h>

#include <regex>
#include <utility>

#include "report/figures/accuracy_chart.hpp"
#include "report/page/page_sections.hpp"
#include "support/well_formed.hpp"

namespace triptych::report {
namespace {

using testing::HasSubstr;

accuracy::AccuracyCase at(const std::string& step, double time, double rmse) {
  return {.configuration = "step=" + step,
          .factors = {{"data", "ball"}, {"step", step}},
          .time_ns = time,
          .samples = {},
          .instructions = static_cast<std::uint64_t>(time),
          .fetched = 5U << 20,
          .memory = 3U << 20,
          .joules = 0.25,
          .rmse = rmse};
}

accuracy::AccuracyScene some_scene() {
  accuracy::AccuracyScene scene;
  scene.device = "gl:x";
  scene.limit = "ball of 64";
  scene.scene = "data=ball <1>,viewport=64";
  scene.data = "ball <1>";
  scene.empty_image_error = 1;
  scene.cases = {at("1", 1e6, 1e-3), at("0.5", 2e6, 2.5e-4), at("0.25", 4e6, 6.25e-5),
                 at("0.125", 8e6, 0), at("2", 3e6, 4e-3)};
  accuracy::evaluate(scene);
  return scene;
}

// Returns the report section for a scene without measured times.
std::string untimed_section(accuracy::AccuracyScene scene = some_scene()) {
  for (accuracy::AccuracyCase& each : scene.cases) each.time_ns.reset();
  accuracy::evaluate(scene);
  judge::GateResult verdict;
  verdict.accuracies = {scene};
  return accuracy_section({.prefix = "plan0", .devices = {}, .records = {}, .verdict = &verdict})
      .text();
}

TEST(AccuracyChart, ShowsOnlyCasesThatFitLogarithmicAxes) {
  const std::vector<accuracy::AccuracyScene> scenes{some_scene()};
  const std::string html = accuracy_chart(scenes, Cost::time).text();
  EXPECT_EQ(test::xml_fault(html), "") << html;
  EXPECT_THAT(html, HasSubstr("step=2: RMSE 0.004, 3 ms"));
  EXPECT_THAT(html, HasSubstr("the front"));
  // A logarithmic axis cannot show a case without any error.
  EXPECT_THAT(html, testing::Not(HasSubstr("step=0.125:")));
  EXPECT_EQ(accuracy_chart(scenes, Cost::samples).text(), "");
  EXPECT_THAT(accuracy_chart(scenes, Cost::instructions).text(),
              HasSubstr("step=2: RMSE 0.004, 3 million"));
  EXPECT_THAT(accuracy_chart(scenes, Cost::fetched).text(), HasSubstr("step=2: RMSE 0.004, 5 MiB"));
  EXPECT_THAT(accuracy_chart(scenes, Cost::memory).text(), HasSubstr("step=2: RMSE 0.004, 3 MiB"));
  EXPECT_THAT(accuracy_chart(scenes, Cost::energy).text(), HasSubstr("step=2: RMSE 0.004, 0.25 J"));
}

// The legend has a line for each family with a long name.
TEST(AccuracyChart, TheLegendIsSmallerThanTheChart) {
  accuracy::AccuracyScene scene = some_scene();
  const std::vector<accuracy::AccuracyCase> cases = std::exchange(scene.cases, {});
  for (int i = 0; i < 8; ++i) {
    for (accuracy::AccuracyCase each : cases) {
      const std::string window = fmt::format("a window with quite a long name, number {}", i);
      each.factors["window"] = window;
      each.configuration += ",window=" + window;
      each.time_ns = *each.time_ns * (1 + i);
      scene.cases.push_back(std::move(each));
    }
  }
  accuracy::evaluate(scene);
  ASSERT_EQ(scene.families.size(), 8U);
  const std::string html = accuracy_chart(std::vector{scene}, Cost::time).text();
  std::smatch area;
  ASSERT_TRUE(std::regex_search(
      html, area,
      std::regex("class=\"marks\" x=\"\\d+\" y=\"(\\d+)\" width=\"\\d+\" height=\"(\\d+)\"")))
      << html;
  EXPECT_LT(std::stoi(area[1]), std::stoi(area[2])) << "the space above the chart, and its height";
}

// Each axis has its own Pareto front. On the memory axis, the case with the smallest non-zero error
// also needs the least memory, so it is the only case on the front.
TEST(AccuracyChart, DrawsTheFrontOfTheShownCases) {
  std::vector<accuracy::AccuracyScene> scenes{some_scene()};
  scenes[0].cases[2].memory = 1U << 20;
  const auto rings = [&scenes](Cost cost) {
    const std::string html = accuracy_chart(scenes, cost).text();
    std::size_t count = 0;
    for (std::size_t at = 0; (at = html.find("class=\"line ink\"", at)) != std::string::npos; ++at)
      ++count;
    return count;
  };
  EXPECT_EQ(rings(Cost::time), 1 + 3 + 1);  // line, points, legend
  EXPECT_EQ(rings(Cost::memory), 1 + 1 + 1);
}

TEST(AccuracySection, ShowsOrdersTimesAndParts) {
  judge::GateResult verdict;
  PlanData plan{.prefix = "plan0", .devices = {}, .records = {}, .verdict = &verdict};
  EXPECT_TRUE(accuracy_section(plan).empty());
  verdict.accuracies = {some_scene()};
  const std::string text = accuracy_section(plan).text();
  EXPECT_THAT(text, HasSubstr("2.00 ± 0.00 (3 step sizes)"));
  EXPECT_THAT(text, HasSubstr("ball &lt;1&gt;"));
  EXPECT_THAT(text, HasSubstr("1 of 5"));  // the number of dominated cases
  EXPECT_THAT(text, HasSubstr("step 0.125 → 0.25"));
  EXPECT_THAT(text, HasSubstr("frame time, ms"));
  EXPECT_THAT(text, HasSubstr("device memory, MiB"));
  EXPECT_THAT(text, HasSubstr("energy per frame, J"));
  EXPECT_THAT(text, HasSubstr("instructions, millions"));
  EXPECT_THAT(text, HasSubstr("cache misses, MiB"));
}

// Here, the plan counts instructions but measures no times.
TEST(AccuracySection, ShowsInstructionsIfThereAreNoTimes) {
  const std::string text = untimed_section();
  EXPECT_THAT(text, HasSubstr("1.0 M instructions"));  // the cost of an RMSE of 1/255
  EXPECT_THAT(text, HasSubstr("3.2 M instructions"));  // the cost of an RMSE of 1e-4, interpolated
  EXPECT_THAT(text, testing::Not(HasSubstr("frame time, ms")));
}

TEST(AccuracySection, RanksByInstructionsIfThereAreNoTimes) {
  EXPECT_THAT(untimed_section(), testing::AllOf(HasSubstr(">4</td>"), HasSubstr(">1 of 5</td>")));
  accuracy::AccuracyScene coarse = some_scene();
  coarse.cases.resize(1);
  EXPECT_THAT(untimed_section(coarse), HasSubstr(">not reached</td>"));
  for (accuracy::AccuracyCase& each : coarse.cases) each.instructions.reset();
  EXPECT_THAT(untimed_section(coarse), testing::AllOf(testing::Not(HasSubstr("not reached")),
                                                      testing::Not(HasSubstr("0 of 1"))));
}

TEST(AccuracySection, ComparesDevicesByTheArea) {
  accuracy::AccuracyScene slower = some_scene();
  slower.device = "gl:slower";
  for (accuracy::AccuracyCase& each : slower.cases) *each.time_ns *= 3;
  accuracy::evaluate(slower);
  judge::GateResult verdict;
  verdict.accuracies = {some_scene(), slower};
  const PlanData plan{.prefix = "plan0", .devices = {}, .records = {}, .verdict = &verdict};
  const std::string text = accuracy_section(plan).text();
  EXPECT_THAT(text, HasSubstr(">3.00<"));
  EXPECT_THAT(text, HasSubstr(">1.00<"));
}

// Scenes that differ only in image size are listed separately, each under its own name.
TEST(AccuracySection, DistinguishesImageSizesOfTheSameData) {
  accuracy::AccuracyScene finer = some_scene();
  finer.limit = "ball of 128";
  finer.scene = "data=ball <1>,viewport=128";
  for (accuracy::AccuracyCase& each : finer.cases) each.factors["viewport"] = "128";
  accuracy::AccuracyScene scene = some_scene();
  for (accuracy::AccuracyCase& each : scene.cases) each.factors["viewport"] = "64";
  judge::GateResult verdict;
  verdict.accuracies = {scene, finer};
  const PlanData plan{.prefix = "plan0", .devices = {}, .records = {}, .verdict = &verdict};
  const std::string text = accuracy_section(plan).text();
  EXPECT_THAT(text, HasSubstr("ball &lt;1&gt;, viewport=128"));
  EXPECT_THAT(text, HasSubstr("viewport 64 → 128 (a different image)"));
  EXPECT_EQ(accuracy_title(verdict.accuracies, scene), "ball <1>, viewport=64");
  EXPECT_EQ(accuracy_title(std::vector{scene}, scene), "ball <1>");
}

TEST(AccuracySection, ShowsOnlyErrorsWithoutTimes) {
  const std::string text = untimed_section();
  EXPECT_THAT(text, HasSubstr("2.00 ± 0.00 (3 step sizes)"));
  EXPECT_THAT(text, testing::Not(HasSubstr("frame time, ms")));
  EXPECT_THAT(text, testing::Not(HasSubstr("not reached")));
}

}  // namespace
}  // namespace triptych::report
