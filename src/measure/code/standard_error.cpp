#include "measure/code/standard_error.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstdio>

#include "core/error.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {
namespace {

// Redirects standard error to a file in memory while this object exists.
class Redirected {
 public:
  Redirected()
      : file_(::memfd_create("standard error", MFD_CLOEXEC)), before_(::dup(STDERR_FILENO)) {
    if (!file_ || !before_)
      throw core::IoError("cannot redirect standard error to a file in memory");
    std::fflush(stderr);
    ::dup2(file_.get(), STDERR_FILENO);
  }
  Redirected(const Redirected&) = delete;
  Redirected& operator=(const Redirected&) = delete;
  ~Redirected() {
    std::fflush(stderr);
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
};

}  // namespace

std::string standard_error_of(const std::function<void()>& act) {
  const Redirected redirected;
  act();
  return redirected.text();
}

}  // namespace triptych::measure
