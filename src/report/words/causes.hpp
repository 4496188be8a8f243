#pragma once
// One function for each cause whose sentence needs more than one line of code. They are called only
// by words/observation.cpp.

#include <string>
#include <string_view>
#include <vector>

#include "judge/finding.hpp"

namespace triptych::report::words {

// Formats a number with its noun: "1 pixel", "16 pixels".
[[nodiscard]] std::string counted(double n, std::string_view one, std::string_view many);
// Formats the number of configurations, with some of their names: "12 configurations (A; B; C; …)".
[[nodiscard]] std::string examples(const std::vector<std::string>& configurations);
// Formats a ratio as a change: "+1.4 %". A ratio above 2 is a factor instead: "21 times".
[[nodiscard]] std::string percent(double ratio);
// Names what a result was compared with: "the reference image".
[[nodiscard]] std::string_view text_of(judge::Against against);

[[nodiscard]] std::string within_bound(const judge::Observation& what);
[[nodiscard]] std::string pixels_over_bound(const judge::Observation& what);
[[nodiscard]] std::string not_finite(const judge::Observation& what);
[[nodiscard]] std::string other_surface(const judge::Observation& what);
[[nodiscard]] std::string size_differs(const judge::Observation& what);
[[nodiscard]] std::string reference_changed(const judge::Observation& what);
[[nodiscard]] std::string devices_compared(const judge::Observation& what);

[[nodiscard]] std::string as_stored(const judge::Observation& what);
[[nodiscard]] std::string values_changed(const judge::Observation& what);
[[nodiscard]] std::string other_driver_statistics(const judge::Observation& what);
[[nodiscard]] std::string other_counter(const judge::Observation& what);
[[nodiscard]] std::string other_compiler(const judge::Observation& what);
[[nodiscard]] std::string time(const judge::Observation& what);
[[nodiscard]] std::string times(const judge::Observation& what);
[[nodiscard]] std::string error(const judge::Observation& what);
[[nodiscard]] std::string order(const judge::Observation& what);

[[nodiscard]] std::string residual_moved(const judge::Observation& what);
[[nodiscard]] std::string off_the_line(const judge::Observation& what);
[[nodiscard]] std::string on_the_line(const judge::Observation& what);
[[nodiscard]] std::string no_line(const judge::Observation& what);

[[nodiscard]] std::string score(const judge::Observation& what);
[[nodiscard]] std::string farther_device(const judge::Observation& what);
[[nodiscard]] std::string pixels_differ(const judge::Observation& what);
[[nodiscard]] std::string not_inside(const judge::Observation& what);
[[nodiscard]] std::string other_colour(const judge::Observation& what);
[[nodiscard]] std::string count_too_large(const judge::Observation& what);

}  // namespace triptych::report::words
