// A requested error: the cheapest configuration that keeps it, or why there is none.

#include <gtest/gtest.h>

#include "core/image_io.hpp"
#include "measure/plan/plan.hpp"
#include "program.hpp"
#include "suites/volume/suite.hpp"

namespace triptych::command_line {
namespace {

// What the tiny plan's scene tends to, as a file for a device to replay.
std::filesystem::path limit_picture(const Program& program) {
  const auto suite = volume_suite::make_suite({});
  const measure::Plan plan = measure::default_plan(
      *suite, {{"data", {"generate:gaussian_blob:16"}}, {"viewport", {"16"}}});
  const auto file = program.folder() / "limit.exr";
  core::write_exr(suite->limit(plan.configurations.at(0)).image, file);
  return file;
}

TEST(Error, IsKeptByTheFastestOfItsCandidates) {
  const Program program;
  const std::string script = R"({"images": {"*": ")" + limit_picture(program).string() + "\"}}";
  const Result kept =
      program.run("run volume/quick " + std::string(tiny) + " --error 0.001", script);
  EXPECT_EQ(kept.code, 0) << kept.output;
  EXPECT_NE(kept.output.find("midpoint keeps it with step"), std::string::npos) << kept.output;
  EXPECT_NE(kept.output.find("preintegrated keeps it with step"), std::string::npos);
  EXPECT_EQ(kept.output.find("own keeps it"), std::string::npos) << kept.output;
  EXPECT_NE(kept.output.find("of 0.001"), std::string::npos) << kept.output;
}

TEST(Error, ThatADeviceDoesNotKeepIsToldWithTheLeast) {
  const Program program;
  const Result missed = program.run("run volume/quick " + std::string(tiny) + " --error 0.001");
  EXPECT_EQ(missed.code, 2) << missed.output;
  EXPECT_NE(missed.output.find("no candidate keeps 0.001; the least error is"), std::string::npos)
      << missed.output;
}

TEST(Error, MustBePositiveAndOfASuiteWithAStep) {
  const Program program;
  for (const char* wrong : {"0", "-1", "nan"}) {
    const Result result =
        program.run("run volume/quick " + std::string(tiny) + " --error=" + wrong);
    EXPECT_EQ(result.code, 3) << result.output;
    EXPECT_NE(result.output.find("expected a positive number"), std::string::npos) << result.output;
  }
  const Result particles = program.run("run particles/quick --device 'null:*' --error 0.01");
  EXPECT_EQ(particles.code, 3) << particles.output;
  EXPECT_NE(particles.output.find("suite particles has no step"), std::string::npos)
      << particles.output;
}

}  // namespace
}  // namespace triptych::command_line
