#include "measure/system/interrupt.hpp"

#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>

#include "core/error.hpp"

namespace triptych::measure {

InterruptGuard::InterruptGuard() {
  sigset_t blocked;
  sigemptyset(&blocked);
  for (const int each : {SIGINT, SIGTERM, SIGPIPE}) sigaddset(&blocked, each);
  signals_ = FileDescriptor(::signalfd(-1, &blocked, SFD_CLOEXEC | SFD_NONBLOCK));
  if (!signals_ || ::pthread_sigmask(SIG_BLOCK, &blocked, &before_) != 0) {
    throw core::IoError("cannot set up interrupt handling");
  }
}

InterruptGuard::~InterruptGuard() {
  read_signals();
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  if (signal_ != 0 && !reported_) std::raise(signal_);
}

std::optional<int> InterruptGuard::received_signal() {
  read_signals();
  if (signal_ == 0) return std::nullopt;
  reported_ = true;
  return signal_;
}

void InterruptGuard::read_signals() {
  for (;;) {
    signalfd_siginfo info{};
    const ssize_t got = ::read(signals_.get(), &info, sizeof info);
    if (got < 0 && errno == EINTR) continue;
    if (got != static_cast<ssize_t>(sizeof info)) return;
    if (info.ssi_signo != SIGPIPE) signal_ = static_cast<int>(info.ssi_signo);
  }
}

}  // namespace triptych::measure
