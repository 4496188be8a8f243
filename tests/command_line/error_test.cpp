// Tests requested errors (--error): the result is the cheapest configuration that meets the error,
// or the reason why there is none.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "core/image_io.hpp"
#include "measure/plan/plan.hpp"
#include "program.hpp"
#include "suites/volume/suite.hpp"

namespace triptych::command_line {
namespace {

// Returns a script for devices that draw the limit images of the scenes with these data. The limit
// image of a scene is the image to which its images converge as the step size decreases. `more` is
// added to the script.
std::string drawing_the_limit(const Program& program, const std::vector<std::string>& data,
                              const std::string& viewport, const std::string& more = "") {
  const auto suite = volume_suite::make_suite({});
  std::string images;
  for (const std::string& each : data) {
    const measure::Plan plan =
        measure::default_plan(*suite, {{"data", {each}}, {"viewport", {viewport}}});
    const auto file = program.folder() / fmt::format("limit_{}.exr", images.size());
    core::write_exr(suite->limit(plan.configurations.at(0)).image, file);
    images += fmt::format(R"({}"*{}*": "{}")", images.empty() ? "" : ", ", each, file.string());
  }
  return R"({"images": {)" + images + "}" + more + "}";
}

constexpr const char* blob = "generate:gaussian_blob:16";

TEST(Error, IsMetByTheFastestCandidate) {
  const Program program;
  const Result kept = program.run("run volume/quick " + std::string(tiny) + " --error 0.001",
                                  drawing_the_limit(program, {blob}, "16"));
  EXPECT_EQ(kept.code, 0) << kept.output;
  EXPECT_NE(kept.output.find("midpoint, the trials begin at step"), std::string::npos)
      << kept.output;
  EXPECT_NE(kept.output.find("preintegrated, the trials begin at step"), std::string::npos);
  EXPECT_EQ(kept.output.find("quadrature=own,"), std::string::npos) << kept.output;
  EXPECT_NE(kept.output.find("(limit 0.001:rms)"), std::string::npos) << kept.output;
  // The threshold 0.0002498626708984375 is shortened in sentences.
  EXPECT_FALSE(std::regex_search(kept.output, std::regex("(ert|step)=[0-9.]{10}"))) << kept.output;
  EXPECT_NE(kept.output.find("% of the error of an empty image, covered"), std::string::npos)
      << kept.output;
}

// The step size is first estimated with a smaller image. If the image is very wide, the smaller
// image must not be reduced to a row of a few pixels, because such a row reveals hardly anything
// about the error of the image. The longest step, 4096, could then be chosen.
TEST(Error, IsMetForAVeryWideImage) {
  const Program program;
  const Result kept = program.run(
      "run volume/quick --device 'null:*' --set technique=raycast --set transfer_function=haze "
      "--set data=generate:mandelbulb:32 --set viewport=512x8 --error 0.001",
      drawing_the_limit(program, {"generate:mandelbulb:32"}, "512x8"));
  EXPECT_EQ(kept.code, 0) << kept.output;
  EXPECT_EQ(kept.output.find("step=4096"), std::string::npos) << kept.output;
}

TEST(Error, UsesTheNamedMetric) {
  const Program program;
  const std::string script = drawing_the_limit(program, {blob}, "16");
  for (const char* metric : {"rms", "covered", "p99.9", "max"}) {
    const Result kept =
        program.run(fmt::format("run volume/quick {} --error 0.003:{}", tiny, metric), script);
    EXPECT_EQ(kept.code, 0) << kept.output;
    EXPECT_NE(kept.output.find(fmt::format(", {})", metric)), std::string::npos) << kept.output;
    EXPECT_NE(kept.output.find(fmt::format("(limit 0.003:{})", metric)), std::string::npos);
  }
}

TEST(Error, ThatAnEmptyImageMeetsGivesNoResult) {
  const Program program;
  const Result empty = program.run("run volume/quick " + std::string(tiny) + " --error 0.9");
  EXPECT_EQ(empty.code, 2) << empty.output;
  EXPECT_NE(empty.output.find(
                "an empty image already meets the error limit 0.9:rms, because its error is"),
            std::string::npos)
      << empty.output;
  EXPECT_NE(empty.output.find("of 256 pixels differ from the background"), std::string::npos)
      << empty.output;
}

TEST(Error, OutOfReachInOneSceneStillMeasuresTheOthers) {
  const Program program;
  const std::string constant = "analytic:v1_constant:8";
  const std::string plan = fmt::format(
      "run volume/quick --device 'null:*' --set technique=raycast --set transfer_function=haze "
      "--set data={},generate:mandelbulb:16 --set viewport=16 --error 1e-12:max",
      constant);
  const Result result = program.run(plan, drawing_the_limit(program, {constant}, "16"));
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_NE(
      result.output.find(
          "data=generate:mandelbulb:16,technique=raycast,viewport=16: the error caused by the "
          "step size is too large with every step: the smallest error is "),
      std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("(limit 1e-12:max)"), std::string::npos) << result.output;
}

// If the plan leaves the sampler to the device, the quadrature `cells` and the midpoint rule use
// different samplers. They must still compete with each other as candidates for the same scene, so
// that there is only one result.
TEST(Error, HasOneResultWhateverSamplersTheCandidatesUse) {
  const Program program;
  const Result kept = program.run("run volume/quick " + std::string(tiny) + " --error 0.0001",
                                  drawing_the_limit(program, {blob}, "16"));
  EXPECT_EQ(kept.code, 0) << kept.output;
  EXPECT_NE(kept.output.find("cells, the trials begin at step"), std::string::npos) << kept.output;
  const std::string answer = "null:scripted  raycast";
  const std::size_t first = kept.output.find(answer);
  EXPECT_NE(first, std::string::npos) << kept.output;
  EXPECT_EQ(kept.output.find(answer, first + 1), std::string::npos) << kept.output;
}

// `render --error` draws with the fastest technique, too.
TEST(Error, LetsTechniquesCompete) {
  const Program program;
  const Result result = program.run(
      fmt::format("render volume --device null:scripted --set technique=auto --set data={} --set "
                  "viewport=16 --error 0.001 --out o",
                  blob),
      drawing_the_limit(program, {blob}, "16",
                        R"(, "factors": {"technique=raycast_fragment,*": 0.25})"));
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find("fastest: null:scripted with raycast_fragment, "), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("null:scripted  raycast "), std::string::npos) << result.output;
  EXPECT_NE(program.read("o/frame.json").find("\"technique\": \"raycast_fragment\""),
            std::string::npos);
}

TEST(Error, KeepsTheLevelsThatTheUserSets) {
  const Program program;
  const Result result =
      program.run(fmt::format("render volume --device null:scripted --set data={} --set "
                              "viewport=16 --set step=0.3 --set skip=none --error 0.001 --out o",
                              blob),
                  drawing_the_limit(program, {blob}, "16"));
  EXPECT_EQ(result.code, 0) << result.output;
  const std::string frame = program.read("o/frame.json");
  EXPECT_NE(frame.find("\"step\": \"0.3\""), std::string::npos) << frame;
  EXPECT_NE(frame.find("\"skip\": \"none\""), std::string::npos) << frame;
}

// The other records of the store are slower candidates, which would not be used.
TEST(Error, IsComparedByItsAnswersOnly) {
  const Program program;
  const std::string script =
      drawing_the_limit(program, {blob}, "16", R"(, "devices": [1, 1.7], "base_ns": 1e6)");
  const Result run = program.run(
      "run volume/quick " + std::string(tiny) + " --error 0.001 --store e.sqlite", script);
  ASSERT_EQ(run.code, 0) << run.output;
  const Result table = program.run("compare --apis --store e.sqlite --json", script);
  EXPECT_EQ(table.code, 0) << table.output;
  EXPECT_NE(table.output.find("\"configurations\": 1,"), std::string::npos) << table.output;
}

TEST(Error, IsRejectedForStressCasesBecauseTheyHaveNoLimit) {
  const Program program;
  const Result result = program.run(
      "run volume/stress --device 'null:*' --set data=stress:inside:middle --set "
      "technique=raycast --error 0.01");
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_NE(result.output.find("has no limit image, so no error can be computed"),
            std::string::npos)
      << result.output;
}

TEST(Error, ThatNoCandidateMeetsIsReportedWithTheSmallest) {
  const Program program;
  const Result missed = program.run("run volume/quick " + std::string(tiny) + " --error 0.001");
  EXPECT_EQ(missed.code, 2) << missed.output;
  EXPECT_NE(
      missed.output.find("no candidate meets the error limit 0.001:rms; the smallest error is"),
      std::string::npos)
      << missed.output;
}

TEST(Error, MustBePositiveAndNeedsASuiteWithAStep) {
  const Program program;
  for (const char* wrong : {"0", "-1", "nan"}) {
    const Result result =
        program.run("run volume/quick " + std::string(tiny) + " --error=" + wrong);
    EXPECT_EQ(result.code, 3) << result.output;
    EXPECT_NE(result.output.find("expected a positive number"), std::string::npos) << result.output;
  }
  const Result unknown =
      program.run("run volume/quick " + std::string(tiny) + " --error 0.1:median");
  EXPECT_EQ(unknown.code, 3) << unknown.output;
  EXPECT_NE(
      unknown.output.find("unknown metric 'median'; expected one of rms, covered, p99.9, max"),
      std::string::npos)
      << unknown.output;
  const Result particles = program.run("run particles/quick --device 'null:*' --error 0.01");
  EXPECT_EQ(particles.code, 3) << particles.output;
  EXPECT_NE(particles.output.find("--error works only for volumes"), std::string::npos)
      << particles.output;
  EXPECT_NE(particles.output.find("suite particles has no factor step"), std::string::npos)
      << particles.output;
}

}  // namespace
}  // namespace triptych::command_line
