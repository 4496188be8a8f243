#include "app/terminal.hpp"

#include <unistd.h>

namespace triptych::app {

bool watched() {
  static const bool terminal = ::isatty(STDERR_FILENO) == 1;
  return terminal;
}

void clear_line() {
  if (watched()) say("\r\033[K");
}

void show_loading(const measure::Loading& loading) {
  if (!loading.note.empty()) {
    clear_line();
    say("{}: {}\n", loading.what, loading.note);
    return;
  }
  if (loading.share < 1) {
    show("loading {}: {:.0f} %", loading.what, 100 * loading.share);
  } else {
    clear_line();
  }
}

}  // namespace triptych::app
