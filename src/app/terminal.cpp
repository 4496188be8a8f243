#include "app/terminal.hpp"

#include <unistd.h>

#include <mutex>
#include <set>
#include <string>

namespace triptych::app {
namespace {

// Whether the line was not printed before.
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

void clear_line() {
  if (watched()) say("\r\033[K");
}

void show_loading(const measure::Loading& loading) {
  if (!loading.note.empty()) {
    const std::string line = loading.what + ": " + loading.note;
    if (!is_new(line)) return;
    clear_line();
    say("{}\n", line);
    return;
  }
  if (loading.share < 1) {
    show("loading {}: {:.0f} %", loading.what, 100 * loading.share);
  } else {
    clear_line();
  }
}

}  // namespace triptych::app
