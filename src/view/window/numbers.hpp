#pragma once
// Shows the times and counters of a column as a table.

#include <cstddef>

#include "view/session.hpp"

namespace triptych::view {

// Draws the table into the rest of the current ImGui window. It marks counters that differ from
// those of the first column by more than devices may differ.
void draw_numbers(const Session& session, std::size_t index);

}  // namespace triptych::view
