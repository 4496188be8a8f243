#include "measure/system/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include "core/error.hpp"
#include "measure/system/descendants.hpp"

namespace triptych::measure {
namespace {

[[noreturn]] void fail(const std::string& what, int error) {
  throw core::IoError(fmt::format("{}: {}", what, std::generic_category().message(error)));
}

struct Pipe {
  FileDescriptor read;
  FileDescriptor write;
};

// Moves one end of a pipe to a descriptor number above all numbers that the child uses, so that no
// dup2() in the child overwrites the source of another dup2().
FileDescriptor raised(FileDescriptor low) {
  constexpr int above_child_fds = 16;
  FileDescriptor high(::fcntl(low.get(), F_DUPFD_CLOEXEC, above_child_fds));
  if (!high) fail("cannot duplicate one end of a pipe", errno);
  return high;
}

Pipe make_pipe() {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) fail("cannot create a pipe", errno);
  FileDescriptor read(ends[0]);
  FileDescriptor write(ends[1]);
  return {raised(std::move(read)), raised(std::move(write))};
}

void set_non_blocking(const FileDescriptor& fd) {
  const int flags = ::fcntl(fd.get(), F_GETFL);
  if (flags < 0 || ::fcntl(fd.get(), F_SETFL, flags | O_NONBLOCK) < 0) {
    fail("cannot make a pipe non-blocking", errno);
  }
}

// Uses the system call directly, because the header of glibc 2.36 declares pidfd_open() without C
// linkage. The descriptor is always close-on-exec.
FileDescriptor open_pid_fd(pid_t pid) {
  return FileDescriptor(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
}

class FileActions {
 public:
  FileActions() { check(::posix_spawn_file_actions_init(&actions_)); }
  ~FileActions() { ::posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  void empty_input() {
    check(::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0));
  }
  void pass(const FileDescriptor& fd, int child_fd) {
    check(::posix_spawn_file_actions_adddup2(&actions_, fd.get(), child_fd));
  }
  void close_from(int first) {
    check(::posix_spawn_file_actions_addclosefrom_np(&actions_, first));
  }
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  static void check(int error) {
    if (error != 0) fail("cannot prepare a worker's file descriptors", error);
  }
  posix_spawn_file_actions_t actions_{};
};

// Attributes that give the child its own process group, no blocked signals, and the default action
// for signals that the parent may have changed.
class Attributes {
 public:
  Attributes() {
    check(::posix_spawnattr_init(&attributes_));
    sigset_t signals;
    sigemptyset(&signals);
    check(::posix_spawnattr_setsigmask(&attributes_, &signals));
    for (const int each : {SIGINT, SIGTERM, SIGPIPE, SIGHUP, SIGSEGV, SIGABRT}) {
      sigaddset(&signals, each);
    }
    check(::posix_spawnattr_setsigdefault(&attributes_, &signals));
    check(::posix_spawnattr_setpgroup(&attributes_, 0));
    check(::posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
  }
  ~Attributes() { ::posix_spawnattr_destroy(&attributes_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  [[nodiscard]] const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  static void check(int error) {
    if (error != 0) fail("cannot prepare a worker's process attributes", error);
  }
  posix_spawnattr_t attributes_{};
};

// Returns pointers for posix_spawn(), which expects char* for historical reasons but does not write
// to the strings.
std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (const std::string& text : texts) result.push_back(const_cast<char*>(text.c_str()));
  result.push_back(nullptr);
  return result;
}

}  // namespace

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  if (this != &other) {
    reset();
    fd_ = std::exchange(other.fd_, -1);
  }
  return *this;
}

void FileDescriptor::reset() noexcept {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

std::string describe(const Exit& exit) {
  if (exit.signal == 0) return fmt::format("exited with code {}", exit.code);
  const char* name = ::sigabbrev_np(exit.signal);
  const char* meaning = ::sigdescr_np(exit.signal);
  if (name == nullptr || meaning == nullptr) return fmt::format("killed by signal {}", exit.signal);
  return fmt::format("killed by SIG{} ({})", name, meaning);
}

Process::Process(const std::vector<std::string>& command,
                 const std::vector<std::string>& environment) {
  if (command.empty()) throw core::IoError("the command that starts a worker is empty");
  Pipe request = make_pipe();
  Pipe answer = make_pipe();
  Pipe log = make_pipe();
  FileActions files;
  files.empty_input();
  files.pass(log.write, STDOUT_FILENO);
  files.pass(log.write, STDERR_FILENO);
  files.pass(request.read, child_request_fd);
  files.pass(answer.write, child_answer_fd);
  files.close_from(child_answer_fd + 1);
  const Attributes attributes;
  const std::vector<char*> arguments = pointers(command);
  const std::vector<char*> variables = pointers(environment);
  inherit_orphans();
  const auto spawn = [&](pid_t* pid) {
    return ::posix_spawnp(pid, command.front().c_str(), files.get(), attributes.get(),
                          arguments.data(), variables.data());
  };
  const int error = start_child(spawn, pid_);
  if (error != 0) fail(fmt::format("cannot start '{}'", command.front()), error);
  request_ = std::move(request.write);
  answer_ = std::move(answer.read);
  log_ = std::move(log.read);
  pid_fd_ = open_pid_fd(pid_);
  try {
    if (!pid_fd_) fail("cannot open a pidfd for a worker", errno);
    set_non_blocking(answer_);
    set_non_blocking(log_);
  } catch (...) {
    kill();
    ::waitpid(pid_, nullptr, 0);
    forget_child(pid_);
    throw;
  }
}

Process::~Process() {
  if (exit_) return;
  kill();
  // A process that is blocked inside a kernel driver cannot be reaped even after SIGKILL. This
  // program must not wait for it forever.
  constexpr std::chrono::seconds time_limit{10};
  try {
    if (wait(time_limit)) return;
  } catch (const core::Error&) {
    // If waiting for a child fails, there is nothing left to do.
  }
  forget_child(pid_);
}

void Process::kill() noexcept {
  // Kills the whole process group, because the group outlives its leader while a grandchild (such
  // as a driver's linker) is running.
  if (pid_ > 0) ::kill(-pid_, SIGKILL);
}

std::optional<Exit> Process::wait(std::chrono::milliseconds limit) {
  if (exit_) return exit_;
  const auto deadline = std::chrono::steady_clock::now() + limit;
  pollfd ended{pid_fd_.get(), POLLIN, 0};
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    const int ready = ::poll(&ended, 1, left.count() > 0 ? static_cast<int>(left.count()) : 0);
    if (ready > 0) break;
    if (ready == 0) return std::nullopt;
    if (errno != EINTR) fail("cannot wait for a worker", errno);
  }
  // Kills processes that the child left behind. This is safe, because no other process can get the
  // child's id before the child is reaped.
  kill();
  int status = 0;
  if (::waitpid(pid_, &status, 0) != pid_) fail("cannot reap a worker", errno);
  forget_child(pid_);
  exit_ = WIFSIGNALED(status) ? Exit{0, WTERMSIG(status)} : Exit{WEXITSTATUS(status), 0};
  return exit_;
}

std::optional<std::string> output_of(const std::vector<std::string>& command,
                                     std::vector<std::string> variables) {
  constexpr std::chrono::seconds time_limit{20};
  try {
    for (char** entry = environ; *entry != nullptr; ++entry) variables.emplace_back(*entry);
    Process process(command, variables);
    const std::optional<Exit> exit = process.wait(time_limit);
    if (!exit || exit->code != 0 || exit->signal != 0) return std::nullopt;
    std::string text(4096, '\0');
    const ssize_t got = ::read(process.log_fd(), text.data(), text.size());
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return text;
  } catch (const core::IoError&) {
    return std::nullopt;
  }
}

}  // namespace triptych::measure
