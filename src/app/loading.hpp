#pragma once
#include "measure/contract/loading.hpp"

namespace triptych::app {

// On stderr: a line that rewrites itself on a terminal and is gone at the end, plain lines
// elsewhere.
void show_loading(const measure::Loading& loading);

}  // namespace triptych::app
