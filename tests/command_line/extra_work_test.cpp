// Tests that an injected slowdown is real work for the device. The tests count instructions to
// prove it, because times could vary on a busy machine. The contract tests check that the extra
// work does not change a pixel.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "program.hpp"
#include "record/store.hpp"
#include "tests/support/exhaustive_run.hpp"

namespace triptych::command_line {
namespace {

// In each plan, one factor has two levels whose work differs by less than 0.01 %. Therefore a
// single worker process can count the frames with and without the injected work. This saves time,
// because starting a worker process under the emulator takes longer than counting all its frames.
struct Counted {
  const char* plan;
  const char* slower;  // the level for which work is injected
};
constexpr Counted volumes{
    "suite: volume\nchecks: [cost]\ntechnique: [raycast, raycast_fragment]\n"
    "data: [generate:gaussian_blob:16]\ntransfer_function: [haze]\nviewport: [32]\n"
    "step: [1, 1.0001]\n",
    "step=1.0001"};
constexpr Counted particles{
    "suite: particles\nchecks: [cost]\n"
    "technique: [quad_screen, quad_instanced, polygon_adaptive, point, tiles]\n"
    "data: [generate:uniform:300]\nviewport: [32]\nradius_scale: [1, 1.0001]\n",
    "radius_scale=1.0001"};

class ExtraWork : public testing::TestWithParam<const char*> {
 protected:
  struct Pair {
    double plain = 0;
    double slower = 0;
  };

  // Returns the number of instructions in device code for each technique; empty if the device or
  // the counter is missing.
  std::map<std::string, Pair> device_code(const Counted& counted) {
    program.write("p.yaml", counted.plan);
    std::filesystem::remove(program.folder() / "s.sqlite");
    const Result run =
        program.run(fmt::format("run p.yaml --device {} --store s.sqlite --inject slowdown:100@{}",
                                GetParam(), counted.slower));
    std::map<std::string, Pair> found;
    if (!std::filesystem::exists(program.folder() / "s.sqlite")) return found;
    const record::Store records(program.folder() / "s.sqlite", record::Store::Mode::read);
    for (const record::Record& record : records.records(records.runs().front().id)) {
      const auto count = record.cost.find("device_code");
      if (count == record.cost.end()) continue;
      const bool slower = record.configuration.find(counted.slower) != std::string::npos;
      Pair& pair = found[record.factors.at("technique")];
      (slower ? pair.slower : pair.plain) = static_cast<double>(count->second);
    }
    EXPECT_TRUE(run.code == 0 || found.empty()) << run.output;
    return found;
  }

  Program program;
};

// Vulkan and OpenGL share the source code of their shaders, so Vulkan is counted only in the
// nightly run.
TEST_P(ExtraWork, IsDoneByEveryTechnique) {
  if (std::string_view(GetParam()).starts_with("vulkan") && !test::is_exhaustive_run())
    GTEST_SKIP() << "counted only if TRIPTYCH_EVERY_DEVICE is set";
  auto counted = device_code(volumes);
  if (counted.empty() && !HasFailure())
    GTEST_SKIP() << GetParam() << " cannot be counted on this machine";
  counted.merge(device_code(particles));
  EXPECT_GE(counted.size(), 6U);
  for (const auto& [technique, pair] : counted) {
    // `tiles` sorts particles twice and stores each entry twice, but does not repeat the passes
    // over pixels, so its instruction count may grow by less than a factor of 2.
    EXPECT_GT(pair.slower, (technique == "tiles" ? 1.1 : 1.8) * pair.plain) << technique;
    EXPECT_LT(pair.slower, 2.2 * pair.plain) << technique;
    EXPECT_GT(pair.plain, 0) << technique;
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, ExtraWork,
                         testing::Values("opencl:pocl", "vulkan:lavapipe", "gl:llvmpipe-egl"),
                         [](const auto& each) {
                           const std::string id = each.param;
                           return id.substr(0, id.find(':'));
                         });

}  // namespace
}  // namespace triptych::command_line
