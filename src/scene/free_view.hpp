#pragma once
// Cameras at arbitrary positions around the scene, for views that the user controls with the mouse.

#include <optional>
#include <string>
#include <string_view>

namespace triptych::scene {

// A camera that looks at the centre of the box. As a level (value) of the factor (setting)
// `camera`, it is written "view:AZIMUTH/ELEVATION/DISTANCE", such as view:45/20/0.8. `view:45/0/1`
// is the same camera as `orbit_y:1/8`.
struct FreeView {
  double azimuth_deg = 0;    // angle about the y axis, from +z towards +x
  double elevation_deg = 0;  // angle above the horizontal plane, −90 to 90
  double distance = 1;       // in units of the orbits' radius (camera.hpp), 0.001 to 1000

  static constexpr double steepest_deg = 90;
  static constexpr double nearest = 0.001;
  static constexpr double farthest = 1000;
};

// Parses the part after "view:". Returns nullopt if it does not describe such a view.
[[nodiscard]] std::optional<FreeView> parse_free_view(std::string_view text);

// Returns the level of the factor `camera` for this view. Angles are rounded to a tenth of a
// degree, and the distance to a thousandth of the orbits' radius (or to three significant digits if
// it is less than 1). Angles and distance are brought into their valid ranges.
[[nodiscard]] std::string camera_of(const FreeView& view);

// Returns the free view that is closest to the given camera, for a scene that fills a cube. Mouse
// control starts from this view. It has the camera's direction and distance, but not its roll or
// target. Throws the same exceptions as camera_at().
[[nodiscard]] FreeView free_view_near(std::string_view camera);

// Returns the view after a mouse drag. `right` and `down` are fractions of the image height. The
// scene follows the mouse, and a drag across the image height turns the scene by half a turn.
[[nodiscard]] FreeView turned(FreeView view, double right, double down);

// Returns the view after the mouse wheel has moved by this many notches. Positive notches move the
// camera closer.
[[nodiscard]] FreeView approached(FreeView view, double notches);

}  // namespace triptych::scene
