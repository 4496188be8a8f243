#include "measure/code/capture_stderr.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <vector>

#include "core/error.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {
namespace {

// Redirects standard error to a file in memory while this object exists. The C stream `stderr` is
// unbuffered by default. Here it is line-buffered, because Mesa prints each word of a disassembly
// with a separate call. Without buffering, the resulting system calls took a quarter of the compile
// time.
class StderrRedirection {
 public:
  StderrRedirection()
      : file_(::memfd_create("standard error", MFD_CLOEXEC)),
        before_(::dup(STDERR_FILENO)),
        lines_(BUFSIZ) {
    if (!file_ || !before_)
      throw core::IoError("cannot redirect standard error to an in-memory file");
    std::fflush(stderr);
    ::dup2(file_.get(), STDERR_FILENO);
    std::setvbuf(stderr, lines_.data(), _IOLBF, lines_.size());
  }
  StderrRedirection(const StderrRedirection&) = delete;
  StderrRedirection& operator=(const StderrRedirection&) = delete;
  ~StderrRedirection() {
    std::fflush(stderr);
    std::setvbuf(stderr, nullptr, _IONBF, 0);
    ::dup2(before_.get(), STDERR_FILENO);
  }

  [[nodiscard]] std::string text() const {
    std::fflush(stderr);
    std::string text;
    std::array<char, 65536> piece;
    off_t at = 0;
    for (;;) {
      const ssize_t got = ::pread(file_.get(), piece.data(), piece.size(), at);
      if (got <= 0) return text;
      text.append(piece.data(), static_cast<std::size_t>(got));
      at += got;
    }
  }

 private:
  FileDescriptor file_;
  FileDescriptor before_;
  std::vector<char> lines_;
};

}  // namespace

std::string capture_stderr(const std::function<void()>& action) {
  const StderrRedirection redirection;
  action();
  return redirection.text();
}

}  // namespace triptych::measure
