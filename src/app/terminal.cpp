#include "app/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <mutex>
#include <set>
#include <string>

#include "report/screen/progress_log.hpp"
#include "report/words/requested_error.hpp"

namespace triptych::app {
namespace {

// Returns true if the line has not been printed before.
bool is_first_time(const std::string& line) {
  static std::mutex mutex;
  static std::set<std::string> printed;
  const std::scoped_lock lock(mutex);
  return printed.insert(line).second;
}

}  // namespace

bool stderr_is_terminal() {
  static const bool terminal = ::isatty(STDERR_FILENO) == 1;
  return terminal;
}

std::size_t terminal_width() {
  if (!stderr_is_terminal()) return 0;
  constexpr std::size_t default_width = 80;
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : default_width;
}

void show_progress_line(std::string_view text) {
  if (!stderr_is_terminal()) return print_err("{}\n", text);
  clear_line();
  // The line is truncated, because clear_line() cannot erase a line that wraps.
  const std::size_t room = terminal_width();
  print_err("{}", core::printable(text, room > 1 ? room - 1 : 1));
}

void clear_line() {
  if (stderr_is_terminal()) print_err("\r\033[K");
}

void show_note(const measure::Loading& loading) {
  const std::string line = loading.what + ": " + loading.note;
  if (!is_first_time(line)) return;
  clear_line();
  print_err("{}\n", line);
}

void show_loading(const measure::Loading& loading) {
  if (!loading.note.empty()) return show_note(loading);
  if (loading.share < 1) {
    show_progress("loading {}: {:.0f} %", loading.what, 100 * loading.share);
  } else {
    clear_line();
  }
}

void show_rendering(const measure::Rendering& rendering) {
  static std::mutex mutex;
  static report::ShareLog log({.width = terminal_width()});
  const std::scoped_lock lock(mutex);
  const std::string text = log.next(report::words::text_of(rendering), rendering.share);
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

}  // namespace triptych::app
