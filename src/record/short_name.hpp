#pragma once
// Short names of configurations, for logs, test reports and the command line.

#include <string>
#include <string_view>

namespace triptych::record {

struct Record;

// Returns a name such as "volume.quick.raycast.mandelbulb_96.surfaces.orbit_y_1_8.s0_5.v192" for
// the configuration key "camera=orbit_y:1/8,data=generate:mandelbulb:96,step=0.5,…". The name
// contains the suite, the plan, and the values of technique, data, transfer function and camera.
// These are followed by the names and values of all other factors that differ from their defaults,
// sorted by name. The names of two factors are abbreviated: step is `s`, and viewport is `v`. The
// name depends only on the arguments, so it stays the same when a plan changes. It contains only
// letters, digits, '_' and '.'. All configurations of a plan have different names, unless two
// values differ only in separators such as ':' and '/', all of which become '_', or in a file name
// extension.
[[nodiscard]] std::string short_name(std::string_view suite, std::string_view plan,
                                     std::string_view configuration);
[[nodiscard]] std::string short_name(const Record& record);

// Returns the name without suite and plan: "raycast.mandelbulb_96.surfaces.orbit_y_1_8.s0_5.v192".
[[nodiscard]] std::string short_name(std::string_view configuration);

// Returns whether a glob matches the key of the configuration, its short name, or its short name
// without suite and plan.
[[nodiscard]] bool names_configuration(const std::string& glob, std::string_view suite,
                                       std::string_view plan, std::string_view configuration);

}  // namespace triptych::record
