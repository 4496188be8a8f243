#include "backends/gl/isolate.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <string_view>

namespace triptych::gl_backend {
namespace {

constexpr int exit_success = 0;
constexpr int exit_exception = 1;

bool write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(fd, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// Runs in the child process, and ends it with _exit, because the child must not run the parent's
// exit handlers.
[[noreturn]] void run_task(const std::function<std::string()>& task, int fd) {
  // The parent reports a crash of the child. Inherited signal handlers would report it a second
  // time.
  for (const int fatal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) std::signal(fatal, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  try {
    const std::string text = task();
    _exit(write_all(fd, text) ? exit_success : exit_exception);
  } catch (const std::exception& error) {
    write_all(fd, error.what());
  } catch (...) {
    write_all(fd, "unknown exception");
  }
  _exit(exit_exception);
}

// Reads until the end of the stream. Returns false if `limit` elapses first.
bool read_all(int fd, std::chrono::milliseconds limit, std::string& text) {
  const auto end = std::chrono::steady_clock::now() + limit;
  std::array<char, 4096> part{};
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        end - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    pollfd ready{fd, POLLIN, 0};
    const int ready_count = poll(&ready, 1, static_cast<int>(left.count()));
    if (ready_count < 0 && errno != EINTR) return false;
    if (ready_count <= 0) continue;
    const ssize_t size = read(fd, part.data(), part.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return size == 0;
    text.append(part.data(), static_cast<std::size_t>(size));
  }
}

ChildResult conclude(pid_t child, bool in_time, std::string text, std::chrono::milliseconds limit) {
  if (!in_time) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!in_time) return {{}, fmt::format("no response within {} ms", limit.count())};
  if (WIFSIGNALED(status)) return {{}, fmt::format("crashed: {}", strsignal(WTERMSIG(status)))};
  if (WIFEXITED(status) && WEXITSTATUS(status) == exit_success) return {std::move(text), {}};
  return {{}, text.empty() ? "exited without responding" : std::move(text)};
}

}  // namespace

ChildResult run_in_child(const std::function<std::string()>& task,
                         std::chrono::milliseconds limit) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    return {{}, fmt::format("cannot create a pipe: {}", std::strerror(errno))};
  }
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    run_task(task, ends[1]);
  }
  const int fork_error = errno;
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return {{}, fmt::format("cannot create a child process: {}", std::strerror(fork_error))};
  }
  std::string text;
  const bool in_time = read_all(ends[0], limit, text);
  close(ends[0]);
  return conclude(child, in_time, std::move(text), limit);
}

}  // namespace triptych::gl_backend
