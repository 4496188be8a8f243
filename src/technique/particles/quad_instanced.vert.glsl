// The vertex stage of quad_instanced, which uses no vertex buffer. TRI_PARTICLE: the particle of the instance,
// including the base instance. TRI_CORNER: the corner of a triangle strip, from 0 to 3.
TRI_LINK(0) flat out vec4 sprite_sphere;
TRI_LINK(1) flat out vec4 sprite_colour;
TRI_LINK(2) flat out uint sprite_id;
TRI_LINK(3) out vec3 sprite_ray;

void main() {
  uint particle = uint(TRI_PARTICLE);
  int k = int(TRI_CORNER);
  vec4 sphere = camera_space(spheres[particle]);
  Corner corner = quad_corner(sprite_frame(sphere), vec2(k & 1, k >> 1) * 2.0 - 1.0);
#if TRI_COUNT
  if (k == 0) {
    add_count(TRI_COUNT_SPRITES, particle, 1u);
    add_count(TRI_COUNT_VERTICES, particle, 4u);
  }
#endif
  sprite_sphere = sphere;
  sprite_colour = colour_at_vertex(stored_colour(particle));
  sprite_id = ids[particle];
  sprite_ray = corner.ray;
  gl_Position = corner.position;
}
