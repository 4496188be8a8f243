#pragma once
// Runs Triptych on lavapipe with the test layer, which lowers limits of the device or simulates a
// driver fault.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include "backends/vulkan/backend.hpp"
#include "core/file.hpp"
#include "measure/contract/backend.hpp"
#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::layer {

// The names of the plans, which are also the names of their suites.
inline constexpr const char* volume = "volume";
inline constexpr const char* particles = "particles";

class Layered {
 public:
  // `change` is the value of TRIPTYCH_LAYER. If it is empty, the driver is not changed.
  [[nodiscard]] test::Result run(std::string_view change, const std::string& arguments) const {
    const std::string layer =
        change.empty() ? std::string()
                       : fmt::format(
                             "VK_LAYER_PATH='{}' VK_INSTANCE_LAYERS=VK_LAYER_TRIPTYCH_test "
                             "TRIPTYCH_LAYER='{}' ",
                             TRIPTYCH_LAYER_FOLDER, change);
    return test::run_command(fmt::format("cd '{}' && TRIPTYCH_DATA= {}'{}' {}",
                                         folder_.path().string(), layer, TRIPTYCH_PROGRAM,
                                         arguments));
  }

  // Draws tests/layer/PLAN.yaml into PLAN.sqlite, with only one frame for the image and one for the
  // counters.
  [[nodiscard]] test::Result draw(std::string_view change, std::string_view plan,
                                  const std::string& choice = "--device 'vulkan:*'") const {
    std::filesystem::remove(folder_.path() / fmt::format("{}.sqlite", plan));
    return run(change, fmt::format("run {} {} --untimed --verbose --store {}.sqlite", file_of(plan),
                                   choice, plan));
  }

  [[nodiscard]] test::Result judge(std::string_view plan, const std::string& more = {}) const {
    return run("", fmt::format("gate {0} --store {1}.sqlite --baselines baselines --check "
                               "image --check counters{2}",
                               file_of(plan), plan, more));
  }
  // Like judge(), but returns gate.log, which contains every finding.
  [[nodiscard]] std::string log_of(std::string_view plan) const {
    static_cast<void>(judge(plan, " --out verdict"));
    return core::read_text(folder_.path() / "verdict" / "gate.log");
  }

  // Accepts the current images and counters as correct.
  [[nodiscard]] test::Result accept(std::string_view plan,
                                    const std::string& choice = "--device 'vulkan:*'") const {
    test::Result drawn = draw("", plan, choice);
    if (drawn.code != 0) return drawn;
    return run("", fmt::format("accept {} --store {}.sqlite --baselines baselines --reason test",
                               file_of(plan), plan));
  }

  // Unlike draw(), also measures times and pipeline statistics. Measures only the configurations
  // that `choice` selects.
  [[nodiscard]] test::Result time(std::string_view change, std::string_view plan,
                                  std::string_view choice) const {
    return run(change, fmt::format("run {} --device 'vulkan:*' --verbose --store timed.sqlite {}",
                                   file_of(plan), choice));
  }

  [[nodiscard]] static bool has_lavapipe() {
    return std::ranges::any_of(
        vulkan_backend::make_backend()->list().devices,
        [](const record::Device& each) { return each.id == "vulkan:lavapipe"; });
  }

 private:
  static std::string file_of(std::string_view plan) {
    return fmt::format("'{}/{}.yaml'", TRIPTYCH_LAYER_PLANS, plan);
  }

  test::TemporaryFolder folder_;
};

class LayerTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!Layered::has_lavapipe()) GTEST_SKIP() << "needs lavapipe";
  }
  Layered layered;
};

}  // namespace triptych::layer
