// The emulator, its plugin and the worker's side of it, together.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <variant>
#include <vector>

#include "measure/counting/emulator.hpp"
#include "measure/counting/instruction_counter.hpp"
#include "measure/process.hpp"

namespace triptych::measure {
namespace {

// What the helper prints and how it ends.
std::pair<std::string, Exit> run(const std::vector<std::string>& command) {
  Process process(command, {"PATH=/usr/bin:/bin"});
  const auto exit = process.wait(std::chrono::seconds(60));
  std::string text(4096, ' ');
  const ssize_t got = ::read(process.log_fd(), text.data(), text.size());
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return {text, exit.value_or(Exit{.code = -1})};
}

std::vector<std::string> counted(const std::string& loops, std::string_view device_files) {
  return emulated(std::get<Emulator>(find_emulator()), {MEASURE_RUN_HELPER, "count", loops},
                  device_files);
}

class Counting : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto* reason = std::get_if<std::string>(&find_emulator())) GTEST_SKIP() << *reason;
  }
};

TEST_F(Counting, CodeInMemoryIsDeviceCodeToTheInstruction) {
  const auto [text, exit] = run(counted("1000", "/nowhere"));
  EXPECT_EQ(exit.code, 0);
  EXPECT_EQ(text, "2002 0 1\n2002 0 1\n2002 0 1\n");
}

TEST_F(Counting, OneInstructionMoreIsSeen) {
  EXPECT_THAT(run(counted("1001", "/nowhere")).first, testing::StartsWith("2004 0 1\n"));
}

// PoCL's kernels are files: in its cache they are device code.
TEST_F(Counting, FilesOfTheKernelCacheAreDeviceCode) {
  const std::string folder = std::string(MEASURE_RUN_HELPER).substr(0, 5);
  EXPECT_THAT(run(counted("1000", folder)).first, testing::Not(testing::StartsWith("2002 ")));
}

TEST_F(Counting, TheEmulatorIsNamedWithItsProcessor) {
  EXPECT_THAT(std::get<Emulator>(find_emulator()).name,
              testing::MatchesRegex("qemu [0-9]+\\.[0-9]+ Haswell"));
}

TEST(InstructionCounter, IsNotThereNatively) {
  EXPECT_FALSE(InstructionCounter::of_this_process());
}

TEST(InstructionCounter, TellsWhatWasTakenSince) {
  const record::Counts taken = InstructionCounter::between({1, 5, 0, 0, 2}, {1, 12, 0, 0, 3});
  EXPECT_EQ(taken.at("driver"), 7U);
  EXPECT_EQ(taken.at("device_code"), 0U);
  EXPECT_EQ(taken.at("allocations"), 1U);
}

}  // namespace
}  // namespace triptych::measure
