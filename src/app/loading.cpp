#include "app/loading.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace triptych::app {

void show_loading(const measure::Loading& loading) {
  static const bool terminal = ::isatty(STDERR_FILENO) == 1;
  const bool over = loading.share >= 1;
  if (terminal) fmt::print(stderr, "\r\033[K");
  if (!over) {
    fmt::print(stderr, "loading {}: {:.0f} %{}", loading.what, 100 * loading.share,
               terminal ? "" : "\n");
  }
}

}  // namespace triptych::app
