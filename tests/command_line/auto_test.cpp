// Tests `technique=auto`, which measures every technique, reports the fastest one and draws it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "program.hpp"

namespace triptych::command_line {
namespace {

constexpr const char* spheres =
    "--device null:scripted --set technique=auto --set data=generate:uniform:100 "
    "--set viewport=16";

std::string fast(const std::string& technique) {
  return fmt::format(R"({{"factors": {{"technique={},*": 0.5}}}})", technique);
}

void expect_found(const Result& result, const std::string& words) {
  EXPECT_NE(result.output.find(words), std::string::npos) << result.output;
}

TEST(Auto, ReportsTheFastestAndTheRatio) {
  const Program program;
  program.write("plan",
                "suite: particles\ntechnique: auto\ndata: [generate:uniform:100, "
                "generate:uniform:200]\nviewport: [16]\nchecks: [image]\n");
  const std::string run = "run plan --device null:scripted --store s.sqlite";
  const Result result = program.run(run, fast("tiles"));
  EXPECT_EQ(result.code, 0) << result.output;
  for (const char* count : {"100", "200"}) {
    expect_found(result, fmt::format("null:scripted camera=orbit_y:1/8,data=generate:uniform:{},"
                                     "viewport=16: tiles is the fastest, ",
                                     count));
  }
  expect_found(result, " clock); ");
  expect_found(result, "polygon_adaptive ");
  // With --resume, the result must come from the store, although a new measurement on this device
  // would find that point is the fastest.
  expect_found(program.run(run + " --resume", fast("point")), ": tiles is the fastest, ");
  expect_found(program.run("run plan --device null:scripted --store t.sqlite", fast("point")),
               ": point is the fastest, ");
}

TEST(Auto, IsNeverStoredAsALevel) {
  const Program program;
  const Result listed =
      program.run(fmt::format("list particles/quick {}", "--set technique=auto --set viewport=16"));
  EXPECT_EQ(listed.code, 0) << listed.output;
  EXPECT_EQ(listed.output.find("technique=auto"), std::string::npos) << listed.output;
  expect_found(listed, "technique=tiles");
}

TEST(Auto, DrawsTheFastest) {
  const Program program;
  const Result result =
      program.run(fmt::format("render particles {} --out o", spheres), fast("point"));
  EXPECT_EQ(result.code, 0) << result.output;
  expect_found(result, ": point is the fastest, ");
  EXPECT_NE(program.read("o/frame.json").find("\"technique\": \"point\""), std::string::npos);
}

TEST(Auto, NeedsTimes) {
  const Program program;
  const Result untimed =
      program.run("run particles/quick --set technique=auto --device null:scripted --untimed");
  EXPECT_EQ(untimed.code, 3) << untimed.output;
  expect_found(untimed, "technique=auto needs frame times; remove --untimed");
  const Result unknown =
      program.run("render particles --device null:scripted --set culling=auto --out o");
  EXPECT_EQ(unknown.code, 3) << unknown.output;
}

}  // namespace
}  // namespace triptych::command_line
