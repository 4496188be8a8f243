#pragma once
// Times and counters of a column as a table.

#include <cstddef>

#include "view/session.hpp"

namespace triptych::view {

// Draws them into the rest of the current ImGui window. Counters that differ from those of the
// first column by more than devices may differ are marked.
void draw_numbers(const Session& session, std::size_t index);

}  // namespace triptych::view
