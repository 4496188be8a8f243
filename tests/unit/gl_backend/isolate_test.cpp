// Tests the handling of child processes that crash, hang or exit as drivers might.
#include "backends/gl/isolate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace triptych::gl_backend {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

TEST(AskInChild, ReturnsTheAnswerOfTheChild) {
  const std::string long_text(1'000'000, 'x');  // more than fits into a pipe
  const ChildResult result = run_in_child([&] { return long_text; }, 10s);
  EXPECT_EQ(result.text, long_text);
  EXPECT_EQ(result.failure, "");
}

TEST(AskInChild, ReturnsAnEmptyAnswer) {
  EXPECT_EQ(run_in_child([] { return std::string(); }, 10s).failure, "");
}

TEST(AskInChild, ReportsTheSignalOfACrash) {
  const ChildResult result = run_in_child(
      []() -> std::string {
        raise(SIGSEGV);
        return "unreachable";
      },
      10s);
  EXPECT_THAT(result.failure, HasSubstr("crashed: Segmentation fault"));
  EXPECT_EQ(result.text, "");
}

TEST(AskInChild, KillsAChildThatHangs) {
  const auto started = std::chrono::steady_clock::now();
  const ChildResult result = run_in_child(
      [] {
        pause();
        return std::string();
      },
      100ms);
  EXPECT_EQ(result.failure, "no response within 100 ms");
  EXPECT_LT(std::chrono::steady_clock::now() - started, 5s);
}

TEST(AskInChild, ReportsTheMessageOfAnException) {
  const ChildResult result =
      run_in_child([]() -> std::string { throw std::runtime_error("no such library"); }, 10s);
  EXPECT_EQ(result.failure, "no such library");
}

TEST(AskInChild, ReportsAChildThatExits) {
  const ChildResult result = run_in_child([]() -> std::string { _exit(7); }, 10s);
  EXPECT_EQ(result.failure, "exited without responding");
}

}  // namespace
}  // namespace triptych::gl_backend
