#include "measure/system/process.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <thread>

#include "core/error.hpp"
#include "measure/run/runner.hpp"
#include "measure/worker/worker_link.hpp"
#include "tests/unit/measure_run/spawning.hpp"

namespace triptych::measure {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

Process shell(const std::string& text) {
  return Process({"/bin/sh", "-c", text}, {"PATH=/usr/bin:/bin"});
}

// Reads everything that the child writes before it closes the pipe.
std::string read_all(int fd) {
  std::string text;
  std::array<char, 4096> piece{};
  for (;;) {
    const ssize_t got = ::read(fd, piece.data(), piece.size());
    if (got == 0) return text;
    if (got > 0) text.append(piece.data(), static_cast<std::size_t>(got));
    if (got < 0) std::this_thread::sleep_for(milliseconds(1));
  }
}

bool alive(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/stat");
  std::string id;
  std::string name;
  std::string state;
  return static_cast<bool>(status >> id >> name >> state) && state != "Z";
}

TEST(Process, ConnectsRequestsAnswersAndBothOutputs) {
  Process process = shell("read line <&3; echo got $line >&4; echo out; echo err >&2");
  ASSERT_EQ(::write(process.request_fd(), "hi\n", 3), 3);
  EXPECT_EQ(read_all(process.answer_fd()), "got hi\n");
  EXPECT_EQ(read_all(process.log_fd()), "out\nerr\n");
  const auto exit = process.wait(seconds(5));
  ASSERT_TRUE(exit);
  EXPECT_EQ(describe(*exit), "exited with code 0");
}

TEST(Process, PassesOnlyTheGivenDescriptorsAndEnvironment) {
  const FileDescriptor opened(::open("/dev/null", O_RDONLY));
  const FileDescriptor inheritable(
      ::dup2(opened.get(), 40));  // neither descriptor is close-on-exec
  ASSERT_EQ(::setenv("TRIPTYCH_STRAY", "1", 1), 0);
  Process process = shell("for fd in /proc/$$/fd/*; do echo ${fd##*/}; done; echo $TRIPTYCH_STRAY");
  // The child has no other open descriptors. It opened descriptor 5 itself to read the list.
  EXPECT_EQ(read_all(process.log_fd()), "0\n1\n2\n3\n4\n5\n\n");
}

TEST(Process, ReportsHowItEnded) {
  Process by_signal = shell("kill -SEGV $$");
  EXPECT_EQ(describe(by_signal.wait(seconds(5)).value()), "killed by SIGSEGV (Segmentation fault)");
  Process by_code = shell("exit 3");
  EXPECT_EQ(describe(by_code.wait(seconds(5)).value()), "exited with code 3");
}

TEST(Process, WaitingEndsAtItsLimit) {
  Process process = shell("sleep 100");
  EXPECT_EQ(process.wait(milliseconds(20)).has_value(), false);
  process.kill();
  EXPECT_EQ(process.wait(seconds(5)).value().signal, SIGKILL);
}

TEST(Process, DestructionKillsTheWholeGroupAndLeavesNoZombie) {
  pid_t grandchild = 0;
  {
    Process process = shell("sleep 100 4>&- & echo $! >&4; exec 4>&-; wait");
    grandchild = std::stoi(read_all(process.answer_fd()));
    ASSERT_TRUE(alive(grandchild));
  }
  for (int i = 0; i < 200 && alive(grandchild); ++i) std::this_thread::sleep_for(milliseconds(10));
  EXPECT_FALSE(alive(grandchild));
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

// A shell script that starts a daemon in its own session and prints the daemon's process id.
constexpr const char* starts_a_daemon =
    "setsid sh -c 'echo $$ >&4; exec sleep 100 4>&-' & exec 4>&-; ";

bool ends_soon(pid_t pid) {
  for (int i = 0; i < 200 && alive(pid); ++i) std::this_thread::sleep_for(milliseconds(10));
  return !alive(pid);
}

TEST(Process, DestructionKillsProcessesThatLeftTheGroup) {
  pid_t daemon = 0;
  {
    Process process = shell(std::string(starts_a_daemon) + "wait");
    daemon = std::stoi(read_all(process.answer_fd()));
    ASSERT_TRUE(alive(daemon));
    ASSERT_NE(::getpgid(daemon), process.pid());
  }
  EXPECT_TRUE(ends_soon(daemon));
}

TEST(Process, LeftoverProcessesAreKilledWhenItExits) {
  Process process = shell(starts_a_daemon);
  const pid_t daemon = std::stoi(read_all(process.answer_fd()));
  ASSERT_TRUE(process.wait(seconds(5)));
  EXPECT_TRUE(ends_soon(daemon));
}

// While two processes run, it is unknown which of them started the daemon, so the daemon is killed
// only after both have ended.
TEST(Process, LeftoverProcessesAreKilledWithTheLastChild) {
  pid_t daemon = 0;
  {
    Process other = shell("sleep 100");
    {
      Process process = shell(starts_a_daemon);
      daemon = std::stoi(read_all(process.answer_fd()));
      ASSERT_TRUE(process.wait(seconds(5)));
    }
    EXPECT_TRUE(alive(daemon));
    EXPECT_TRUE(alive(other.pid()));
  }
  EXPECT_TRUE(ends_soon(daemon));
}

// If a program starts a child and then replaces itself with this program, that child may still be
// running and must not be killed.
TEST(Process, EarlierChildrenAreNotKilled) {
  Process process = shell("sleep 100 & exec '" MEASURE_RUN_HELPER "' keeps $!");
  EXPECT_EQ(describe(process.wait(seconds(20)).value()), "exited with code 0");
}

TEST(Process, AMissingProgramIsAnIoError) {
  if (!spawning_reports_a_missing_program()) GTEST_SKIP() << spawning_does_not_report;
  EXPECT_THROW(Process({"/nowhere/triptych"}, {}), core::IoError);
  EXPECT_THROW(Process({}, {}), core::IoError);
}

TEST(LogTail, KeepsTheLastLinesOfLongOutput) {
  LogTail log;
  for (int i = 0; i < 10000; ++i) log.append("line " + std::to_string(i) + "\n\n");
  EXPECT_EQ(log.last_lines(2), "line 9998 | line 9999");
  log.append("without end");
  EXPECT_EQ(log.last_lines(1), "without end");
  log.clear();
  EXPECT_EQ(log.last_lines(3), "");
}

TEST(WorkerLink, AWorkerWithInvalidAnswersIsKilledAndQuoted) {
  InterruptGuard interrupts;
  WorkerLink link(
      {"/bin/sh", "-c", "echo broken >&2; echo 'no message, only some words' >&4; sleep 100"},
      {"PATH=/usr/bin:/bin"}, interrupts);
  const auto reply = link.send_request(to_message(Start{}), seconds(10));
  const auto* died = std::get_if<WorkerLink::Died>(&reply);
  ASSERT_NE(died, nullptr);
  EXPECT_EQ(died->reason.cause, record::Cause::bad_answer);
  EXPECT_THAT(died->reason.detail, testing::HasSubstr("not a message"));
  EXPECT_EQ(died->reason.last_output, "broken");
}

TEST(WorkerLink, AnInterruptEndsTheWaiting) {
  InterruptGuard interrupts;
  WorkerLink link({"/bin/sh", "-c", "sleep 100"}, {"PATH=/usr/bin:/bin"}, interrupts);
  ::raise(SIGTERM);
  EXPECT_THROW(static_cast<void>(link.send_request(to_message(Start{}), seconds(10))), Interrupted);
}

}  // namespace
}  // namespace triptych::measure
