// An injected slowdown is real work for the device. The tests count instructions to prove it,
// because times could differ on a busy machine. The contract tests check that it changes no pixel.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "program.hpp"
#include "record/store.hpp"

namespace triptych::command_line {
namespace {

constexpr const char* volumes =
    "suite: volume\nchecks: [cost]\ntechnique: [raycast, raycast_fragment]\n"
    "data: [generate:gaussian_blob:16]\ntransfer_function: [haze]\nviewport: [48]\n";
constexpr const char* particles =
    "suite: particles\nchecks: [cost]\n"
    "technique: [quad_screen, quad_instanced, polygon_adaptive, point, tiles]\n"
    "data: [generate:uniform:500]\nviewport: [48]\n";

class ExtraWork : public testing::TestWithParam<const char*> {
 protected:
  // Instructions of device code by configuration; empty if the device or the counter is missing.
  std::map<std::string, double> device_code(const std::string& store, const std::string& fault) {
    const Result run =
        program.run(fmt::format("run volumes.yaml particles.yaml --device {} "
                                "--store {} {}",
                                GetParam(), store, fault));
    std::map<std::string, double> counted;
    if (!std::filesystem::exists(program.folder() / store)) return counted;
    const record::Store records(program.folder() / store, record::Store::Mode::read);
    for (const record::Run& each : records.runs()) {
      for (const record::Record& record : records.records(each.id)) {
        const auto count = record.cost.find("device_code");
        if (count != record.cost.end()) {
          counted[record.configuration] = static_cast<double>(count->second);
        }
      }
    }
    EXPECT_TRUE(run.code == 0 || counted.empty()) << run.output;
    return counted;
  }

  Program program;
};

TEST_P(ExtraWork, IsDoneByEveryTechnique) {
  program.write("volumes.yaml", volumes);
  program.write("particles.yaml", particles);
  const auto plain = device_code("plain.sqlite", "");
  if (plain.empty() && !HasFailure()) GTEST_SKIP() << GetParam() << " is not counted here";
  const auto twice = device_code("twice.sqlite", "--inject slowdown:100");
  ASSERT_EQ(twice.size(), plain.size());
  for (const auto& [configuration, count] : plain) {
    // `tiles` sorts particles twice and has each entry twice. Passes over pixels are not repeated.
    const bool is_tiles = configuration.find("technique=tiles") != std::string::npos;
    EXPECT_GT(twice.at(configuration), (is_tiles ? 1.1 : 1.8) * count) << configuration;
    EXPECT_LT(twice.at(configuration), 2.2 * count) << configuration;
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
