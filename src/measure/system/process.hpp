#pragma once
// A child process with three pipes, owned: whatever happens, it is killed and reaped, its
// descriptors closed. Linux (posix_spawn, pidfd).

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

// How a process ended: by a signal (signal != 0) or by itself.
struct Exit {
  int code = 0;
  int signal = 0;
};
// "killed by SIGSEGV (Segmentation fault)", "exited with code 3".
[[nodiscard]] std::string describe(const Exit& exit);

// The child reads requests at `child_request_fd` and writes answers at `child_answer_fd`; its
// standard input is empty, its standard output and error both end in the log pipe, so that nothing
// a driver prints can mix with the answers. No other descriptor of ours reaches it. It leads a
// process group of its own: what it starts dies with it, and what leaves the group dies with the
// last process of this kind (descendants.hpp).
class Process {
 public:
  static constexpr int child_request_fd = 3;
  static constexpr int child_answer_fd = 4;

  // `command` is looked up in PATH; `environment` is the child's whole environment, "NAME=VALUE"
  // each. Throws IoError when it cannot be started.
  Process(const std::vector<std::string>& command, const std::vector<std::string>& environment);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  [[nodiscard]] pid_t pid() const noexcept { return pid_; }
  [[nodiscard]] int request_fd() const noexcept { return request_.get(); }  // blocking
  [[nodiscard]] int answer_fd() const noexcept { return answer_.get(); }    // non-blocking
  [[nodiscard]] int log_fd() const noexcept { return log_.get(); }          // non-blocking
  [[nodiscard]] int pid_fd() const noexcept { return pid_fd_.get(); }  // readable once it has ended

  // SIGKILL to the whole group.
  void kill() noexcept;
  // Closes the requests, by which a child that waits for one knows that it may leave.
  void close_requests() noexcept { request_.reset(); }
  // Waits for the end and reaps; nullopt when it has not ended in time.
  [[nodiscard]] std::optional<Exit> wait(std::chrono::milliseconds limit);

 private:
  pid_t pid_ = -1;
  std::optional<Exit> exit_;
  FileDescriptor request_;
  FileDescriptor answer_;
  FileDescriptor log_;
  FileDescriptor pid_fd_;
};

// The first 4 KiB that a short program prints, in this process's environment and the variables;
// nullopt where it cannot be started, fails or takes more than 20 seconds.
[[nodiscard]] std::optional<std::string> output_of(const std::vector<std::string>& command,
                                                   std::vector<std::string> variables = {});

}  // namespace triptych::measure
