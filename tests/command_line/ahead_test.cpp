// Tests that a worker without the emulator compiles PoCL's kernels in advance. The worker that
// counts instructions under the emulator then only loads them, so the instructions of the compiler
// are not counted.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "program.hpp"
#include "record/store.hpp"

namespace triptych::command_line {
namespace {

TEST(CompilingAhead, LeavesOutTheInstructionsOfPoclsCompiler) {
  const Program program;
  program.write("p.yaml",
                "suite: volume\nchecks: [cost]\ntechnique: [raycast]\n"
                "data: [generate:gaussian_blob:16]\nviewport: [16]\n");
  const Result run =
      program.run("run p.yaml --device opencl:pocl --store s.sqlite", "{}",
                  fmt::format("env XDG_CACHE_HOME='{}'", (program.folder() / "cache").string()));
  if (!std::filesystem::exists(program.folder() / "s.sqlite")) {
    GTEST_SKIP() << "needs PoCL: " << run.output;
  }
  const record::Store records(program.folder() / "s.sqlite", record::Store::Mode::read);
  const auto found = records.records(records.runs().front().id);
  ASSERT_EQ(found.size(), 1U);
  if (!found.front().instructions()) GTEST_SKIP() << "needs the instruction counter";
  if (found.front().counted_by.find("AVX2") == std::string::npos) GTEST_SKIP() << "needs AVX2";
  // PoCL 3.1 executes 5.2e9 instructions to compile this scene's kernel, and 0.5e9 to load it.
  EXPECT_LT(found.front().prepare_cost.at("driver"), 1'500'000'000U);
}

}  // namespace
}  // namespace triptych::command_line
