#pragma once
// A child process with three pipes. Linux only (posix_spawn, pidfd).

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace triptych::measure {

// Owns a file descriptor.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) noexcept : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() { reset(); }

  [[nodiscard]] int get() const noexcept { return fd_; }
  [[nodiscard]] explicit operator bool() const noexcept { return fd_ >= 0; }
  void reset() noexcept;

 private:
  int fd_ = -1;
};

// How a process ended: by a signal (signal != 0), or by itself.
struct Exit {
  int code = 0;
  int signal = 0;
};
// Returns, for example, "killed by SIGSEGV (Segmentation fault)" or "exited with code 3".
[[nodiscard]] std::string describe(const Exit& exit);

// A child process. It reads requests from `child_request_fd` and writes answers to
// `child_answer_fd`. Its standard input is empty. Its standard output and standard error both go to
// the log pipe, so that nothing that a driver prints can mix with the answers. It inherits no other
// descriptors. It leads its own process group: processes that it starts are killed when it ends,
// and processes that leave the group are killed when the last child of this program ends
// (descendants.hpp). The destructor kills and reaps the child and closes all descriptors.
class Process {
 public:
  static constexpr int child_request_fd = 3;
  static constexpr int child_answer_fd = 4;

  // Starts the child. `command` is searched for in PATH. `environment` is the complete environment
  // of the child ("NAME=VALUE"). Throws IoError if the child cannot be started.
  Process(const std::vector<std::string>& command, const std::vector<std::string>& environment);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  [[nodiscard]] pid_t pid() const noexcept { return pid_; }
  [[nodiscard]] int request_fd() const noexcept { return request_.get(); }  // blocking
  [[nodiscard]] int answer_fd() const noexcept { return answer_.get(); }    // non-blocking
  [[nodiscard]] int log_fd() const noexcept { return log_.get(); }          // non-blocking
  // Returns a descriptor that becomes readable when the child has ended.
  [[nodiscard]] int pid_fd() const noexcept { return pid_fd_.get(); }

  // Sends SIGKILL to the whole process group.
  void kill() noexcept;
  // Closes the request pipe, so that a child that waits for a request exits.
  void close_requests() noexcept { request_.reset(); }
  // Waits until the child has ended, and reaps it. Returns nullopt if the child has not ended
  // within `limit`.
  [[nodiscard]] std::optional<Exit> wait(std::chrono::milliseconds limit);

 private:
  pid_t pid_ = -1;
  std::optional<Exit> exit_;
  FileDescriptor request_;
  FileDescriptor answer_;
  FileDescriptor log_;
  FileDescriptor pid_fd_;
};

// Runs a short program with the environment of this process and the given variables. Returns the
// first 4 KiB of its output. Returns nullopt if it cannot be started, fails, or takes more than 20
// seconds.
[[nodiscard]] std::optional<std::string> output_of(const std::vector<std::string>& command,
                                                   std::vector<std::string> variables = {});

}  // namespace triptych::measure
