// Tests that if a plan both counts instructions and judges images, the counts and the images come
// from the same frames.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "program.hpp"
#include "record/store.hpp"

namespace triptych::command_line {
namespace {

constexpr const char* counted_device = "vulkan:lavapipe";

class CountedImages : public testing::Test {
 protected:
  // Returns the records of a plan with these checks; empty if the device or the counter is missing.
  std::vector<record::Record> counted(const std::string& name, const std::string& checks) {
    program.write(name + ".yaml",
                  fmt::format("suite: volume\nchecks: {}\ndata: [generate:mandelbulb:16]\n"
                              "step: [1, 0.5]\nviewport: [16]\n",
                              checks));
    const Result run = program.run(
        fmt::format("run {0}.yaml --device {1} --store {0}.sqlite", name, counted_device));
    const auto store = program.folder() / (name + ".sqlite");
    if (!std::filesystem::exists(store)) return {};
    const record::Store records(store, record::Store::Mode::read);
    std::vector<record::Record> found = records.records(records.runs().front().id);
    std::erase_if(found, [](const record::Record& each) { return !each.instructions(); });
    EXPECT_TRUE(run.code == 0 || found.empty()) << run.output;
    return found;
  }

  Program program;
};

TEST_F(CountedImages, AreStoredIfThePlanJudgesThem) {
  const auto alone = counted("alone", "[cost]");
  if (alone.empty() && !HasFailure())
    GTEST_SKIP() << counted_device << " cannot be counted on this machine";
  const auto both = counted("both", "[cost, image, accuracy]");
  ASSERT_EQ(both.size(), alone.size());
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_TRUE(alone[i].image.empty());
    EXPECT_TRUE(alone[i].counters.empty());
    EXPECT_FALSE(both[i].image.empty());
    EXPECT_GT(both[i].counters.at("samples"), 0U);
    EXPECT_EQ(both[i].cost.at("device_code"), alone[i].cost.at("device_code"));
    EXPECT_GT(both[i].fetched_bytes().value_or(0), 0U);
  }
  const Result judged = program.run("gate both.yaml --store both.sqlite --check image");
  EXPECT_NE(judged.output.find("2 within their error bounds"), std::string::npos) << judged.output;
  const Result printed = program.run("gate both.yaml --store both.sqlite --check accuracy --json");
  EXPECT_NE(printed.output.find("\"fetched_bytes\": "), std::string::npos) << printed.output;
}

}  // namespace
}  // namespace triptych::command_line
