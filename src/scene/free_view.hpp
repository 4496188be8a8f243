#pragma once
// Cameras that may stand anywhere around the scene, for a view that a mouse has chosen.

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

// nullopt if the text after "view:" is no such view.
[[nodiscard]] std::optional<FreeView> parse_free_view(std::string_view text);

// The value of the factor `camera` for this view, with a tenth of a degree and a thousandth of the
// radius (of a nearer view, three significant digits). Angles and distance are brought into their
// ranges.
[[nodiscard]] std::string camera_of(const FreeView& view);

// The free view that is nearest to a camera on a path of a cube, from which turning begins: it has
// the same direction and distance, but neither its roll nor its target. Throws as camera_at() does.
[[nodiscard]] FreeView free_view_near(std::string_view camera);

// The view after the mouse has moved by this share of the image's height, with the button pressed:
// the scene follows the mouse, and half a turn is one height.
[[nodiscard]] FreeView turned(FreeView view, double right, double down);

// The view after the wheel has moved by this many notches; positive ones go nearer.
[[nodiscard]] FreeView approached(FreeView view, double notches);

}  // namespace triptych::scene
