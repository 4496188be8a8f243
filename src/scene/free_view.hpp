#pragma once
// Cameras at arbitrary positions around the scene, for views that are chosen with the mouse.

#include <optional>
#include <string>
#include <string_view>

namespace triptych::scene {

// A camera that looks at the centre of the box. It is spelled
// "view:AZIMUTH/ELEVATION/DISTANCE", such as view:45/20/0.8. `view:45/0/1` is the same camera as
// `orbit_y:1/8`.
struct FreeView {
  double azimuth_deg = 0;    // about the y axis, from +z towards +x
  double elevation_deg = 0;  // above the plane through the centre, −90 to 90
  double distance = 1;       // in units of the radius of the orbits (camera.hpp), 0.001 to 1000

  static constexpr double steepest_deg = 90;
  static constexpr double nearest = 0.001;
  static constexpr double farthest = 1000;
};

// Returns nullopt if the text after "view:" does not describe such a view.
[[nodiscard]] std::optional<FreeView> parse_free_view(std::string_view text);

// The value of the factor `camera` for this view. Angles are rounded to a tenth of a degree, and
// the distance to a thousandth of the radius (or to three significant digits, for a view from
// nearby). Angles and distance are brought into their ranges.
[[nodiscard]] std::string camera_of(const FreeView& view);

// The free view that is nearest to a camera on a path around a cube. It is the view from which
// turning with the mouse starts. It has the same direction and distance, but neither the roll nor
// the target of the camera. Throws as camera_at() does.
[[nodiscard]] FreeView free_view_near(std::string_view camera);

// The view after a mouse drag. `right` and `down` are shares of the image's height. The scene
// follows the mouse, and a drag of one image height turns it by half a turn.
[[nodiscard]] FreeView turned(FreeView view, double right, double down);

// The view after the wheel has moved by this many notches. Positive notches move the camera closer.
[[nodiscard]] FreeView approached(FreeView view, double notches);

}  // namespace triptych::scene
