#include "app/loading.hpp"

#include <unistd.h>

#include "app/saying.hpp"

namespace triptych::app {

void show_loading(const measure::Loading& loading) {
  static const bool terminal = ::isatty(STDERR_FILENO) == 1;
  const bool over = loading.share >= 1;
  if (terminal) say("\r\033[K");
  if (!over) {
    say("loading {}: {:.0f} %", loading.what, 100 * loading.share);
    if (!terminal) say("\n");
  }
}

}  // namespace triptych::app
