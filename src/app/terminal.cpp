#include "app/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <mutex>
#include <set>
#include <string>

namespace triptych::app {
namespace {

// Returns true if the line has not been printed before.
bool is_new(const std::string& line) {
  static std::mutex mutex;
  static std::set<std::string> printed;
  const std::scoped_lock lock(mutex);
  return printed.insert(line).second;
}

}  // namespace

bool watched() {
  static const bool terminal = ::isatty(STDERR_FILENO) == 1;
  return terminal;
}

std::size_t columns() {
  if (!watched()) return 0;
  constexpr std::size_t usual = 80;
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : usual;
}

void show_line(std::string_view text) {
  if (!watched()) return say("{}\n", text);
  clear_line();
  // The line is truncated, because clear_line() cannot erase a line that wraps.
  const std::size_t room = columns();
  say("{}", core::printable(text, room > 1 ? room - 1 : 1));
}

void clear_line() {
  if (watched()) say("\r\033[K");
}

void show_note(const measure::Loading& loading) {
  const std::string line = loading.what + ": " + loading.note;
  if (!is_new(line)) return;
  clear_line();
  say("{}\n", line);
}

void show_loading(const measure::Loading& loading) {
  if (!loading.note.empty()) return show_note(loading);
  if (loading.share < 1) {
    show("loading {}: {:.0f} %", loading.what, 100 * loading.share);
  } else {
    clear_line();
  }
}

}  // namespace triptych::app
