// The vertex stage of point sprites. A point is the square around the part of the silhouette that is inside the
// viewport. If the square exceeds the device's maximum point size, a second draw draws the sphere as a
// screen-aligned quad (point_large.vert.glsl). TRI_POINT_MARGIN: pixels to add on a device that draws points
// smaller than requested. TRI_LARGEST_POINT: the device's maximum point size in pixels, minus this margin.
layout(location = 0) in vec4 sphere;
layout(location = 1) in vec4 colour;
layout(location = 2) in uint id;

TRI_LINK(0) flat out vec4 sprite_sphere;
TRI_LINK(1) flat out vec4 sprite_colour;
TRI_LINK(2) flat out uint sprite_id;
TRI_LINK(3) out vec3 sprite_ray;

void main() {
  sprite_sphere = camera_space(sphere);
  sprite_colour = colour_at_vertex(colour);
  sprite_id = id;
  sprite_ray = vec3(0.0, 0.0, 1.0);  // a point has one vertex, so its rays are computed per pixel
  vec2 low;
  vec2 high;
  image_bounds(sprite_sphere, low, high);
  float size = point_size(low, high);
  Corner corner = nowhere();
  if (low.x <= high.x && low.y <= high.y && size <= TRI_LARGEST_POINT) {
    corner = front_corner(sprite_sphere, low, high, vec2(0.0));
#if TRI_COUNT
    add_count(TRI_COUNT_SPRITES, id, 1u);
    add_count(TRI_COUNT_VERTICES, id, 1u);
#endif
  }
  gl_Position = corner.position;
  gl_PointSize = size + TRI_POINT_MARGIN;
}
