// The vertex stage of the second draw of point sprites. For each sphere whose square exceeds the device's maximum
// point size, it generates the rectangle around the part of the silhouette that is inside the viewport. For all
// other spheres, it generates an empty quad. TRI_PARTICLE and TRI_CORNER have the same meaning as in
// quad_instanced.vert.glsl.
TRI_LINK(0) flat out vec4 sprite_sphere;
TRI_LINK(1) flat out vec4 sprite_colour;
TRI_LINK(2) flat out uint sprite_id;
TRI_LINK(3) out vec3 sprite_ray;

void main() {
  uint particle = uint(TRI_PARTICLE);
  int k = int(TRI_CORNER);
  sprite_sphere = camera_space(spheres[particle]);
  sprite_colour = colour_at_vertex(stored_colour(particle));
  sprite_id = ids[particle];
  vec2 low;
  vec2 high;
  image_bounds(sprite_sphere, low, high);
  bool large = low.x <= high.x && low.y <= high.y && point_size(low, high) > TRI_LARGEST_POINT;
  Corner corner = nowhere();
  if (large) corner = front_corner(sprite_sphere, low, high, vec2(k & 1, k >> 1) * 2.0 - 1.0);
#if TRI_COUNT
  if (large && k == 0) {
    add_count(TRI_COUNT_SPRITES, particle, 1u);
    add_count(TRI_COUNT_VERTICES, particle, 4u);
  }
#endif
  sprite_ray = corner.ray;
  gl_Position = corner.position;
}
