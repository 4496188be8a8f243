// Tests that PoCL's kernels are compiled before they are counted, by a worker without the emulator.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "program.hpp"
#include "record/store.hpp"

namespace triptych::command_line {
namespace {

// Configurations with an injected fault are not compiled ahead, so the instructions of their
// preparation include those of PoCL's compiler.
TEST(CompilingAhead, LeavesOutTheInstructionsOfPoclsCompiler) {
  const Program program;
  program.write("p.yaml",
                "suite: volume\nchecks: [cost]\ntechnique: [raycast]\n"
                "data: [generate:gaussian_blob:16]\nviewport: [16]\nstep: [1, 0.5]\n");
  const Result run = program.run(
      "run p.yaml --device opencl:pocl --store s.sqlite --inject slowdown:100@step=0.5", "{}",
      fmt::format("env XDG_CACHE_HOME='{}'", (program.folder() / "cache").string()));
  if (!std::filesystem::exists(program.folder() / "s.sqlite")) {
    GTEST_SKIP() << "needs PoCL: " << run.output;
  }
  const record::Store records(program.folder() / "s.sqlite", record::Store::Mode::read);
  double ahead = 0;
  double counted = 0;
  for (const record::Record& record : records.records(records.runs().front().id)) {
    if (!record.instructions()) GTEST_SKIP() << "needs the instruction counter";
    double& sum = record.injected.empty() ? ahead : counted;
    for (const char* group : {"device_code", "driver", "libc", "program"}) {
      sum += static_cast<double>(record.prepare_cost.at(group));
    }
  }
  EXPECT_GT(ahead, 0);
  EXPECT_GT(counted, 3 * ahead);
}

}  // namespace
}  // namespace triptych::command_line
