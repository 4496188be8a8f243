#pragma once
// Shows a column's times and counters as a table.

#include <cstddef>

#include "view/session.hpp"

namespace triptych::view {

// Draws the table into the remaining space of the current ImGui window. Highlights counters that
// differ from the first column by more than is allowed between devices.
void draw_numbers(const Session& session, std::size_t index);

}  // namespace triptych::view
