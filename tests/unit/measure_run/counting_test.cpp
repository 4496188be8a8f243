// Counts the instructions of a helper program under the emulator. This tests the emulator, its
// instruction counter, and the code of a worker that reads the counter.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <variant>
#include <vector>

#include "measure/counting/emulator.hpp"
#include "measure/counting/instruction_counter.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {
namespace {

// Runs the helper program under the emulator, and returns its output.
std::string counted(const std::string& loops, std::string_view device_files = "/nowhere",
                    const char* mode = "count") {
  const auto& emulator = std::get<Emulator>(find_emulator());
  std::vector<std::string> variables = emulator.environment;
  variables.emplace_back("PATH=/usr/bin:/bin");
  Process process(emulated(emulator, {MEASURE_RUN_HELPER, mode, loops}, device_files), variables);
  const auto exit = process.wait(std::chrono::seconds(60));
  EXPECT_EQ(exit.value_or(Exit{.code = -1}).code, 0);
  std::string text(4096, ' ');
  const ssize_t got = ::read(process.log_fd(), text.data(), text.size());
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return text;
}

class Counting : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto* reason = std::get_if<std::string>(&find_emulator())) GTEST_SKIP() << *reason;
  }
};

TEST_F(Counting, CodeInMemoryIsCountedExactlyAsDeviceCode) {
  EXPECT_EQ(counted("1000"), "2002 0 1\n2002 0 1\n2002 0 1\n");
}

TEST_F(Counting, OneMoreInstructionIsCounted) {
  EXPECT_THAT(counted("1001"), testing::StartsWith("2004 0 1\n"));
}

// PoCL loads its kernels from files, so code from files in its kernel cache must count as device
// code. Here, the folder that contains the helper program takes the place of the kernel cache. The
// helper's own code then counts as device code, too, so the count is not 2002.
TEST_F(Counting, FilesOfTheKernelCacheAreDeviceCode) {
  const std::string folder = std::string(MEASURE_RUN_HELPER).substr(0, 5);
  EXPECT_THAT(counted("1000", folder), testing::Not(testing::StartsWith("2002 ")));
}

TEST_F(Counting, WaitsForOtherThreads) {
  EXPECT_EQ(counted("1000", "/nowhere", "count-busy"), "2002 0 1\n2002 0 1\n2002 0 1\n");
}

// The addresses of the 1,000 loads are 64 or 8 bytes apart. With 64 bytes, the loads touch 1,000
// cache lines, which do not fit into the cache, so each line is missed every time. With 8 bytes,
// they touch 125 lines, which fit, so each line is missed only the first time. The stack line with
// the return address adds one miss.
TEST_F(Counting, CacheMissesAreCountedSeparately) {
  EXPECT_EQ(counted("64", "/nowhere", "count-stride"), "4002 1001\n4002 1001\n4002 1001\n");
  EXPECT_EQ(counted("8", "/nowhere", "count-stride"), "4002 126\n4002 0\n4002 0\n");
}

TEST_F(Counting, TheEmulatorNameIncludesTheProcessor) {
  EXPECT_THAT(std::get<Emulator>(find_emulator()).name,
              testing::MatchesRegex("valgrind [0-9]+\\.[0-9]+ (AVX2|SSE)"));
}

TEST(InstructionCounter, IsAbsentWithoutTheEmulator) {
  EXPECT_FALSE(InstructionCounter::of_this_process());
}

TEST(InstructionCounter, CountsSinceThePreviousReading) {
  const record::Counts taken = InstructionCounter::between({1, 5, 0, 0, 2, 0}, {1, 12, 0, 0, 3, 0});
  EXPECT_EQ(taken.at("driver"), 7U);
  EXPECT_EQ(taken.at("device_code"), 0U);
  EXPECT_EQ(taken.at("allocations"), 1U);
}

}  // namespace
}  // namespace triptych::measure
