// Expands a point to a quad, which is screen-aligned if TRI_SCREEN_ALIGNED is 1 and ray-aligned if
// it is 0.
layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

TRI_LINK(0) in vec4 particle_sphere[];
TRI_LINK(1) in vec4 particle_colour[];
TRI_LINK(2) flat in uint particle_id[];

TRI_LINK(0) flat out vec4 sprite_sphere;
TRI_LINK(1) flat out vec4 sprite_colour;
TRI_LINK(2) flat out uint sprite_id;
TRI_LINK(3) out vec3 sprite_ray;

void emit(Corner corner) {
  sprite_sphere = particle_sphere[0];
  sprite_colour = particle_colour[0];
  sprite_id = particle_id[0];
  sprite_ray = corner.ray;
  gl_Position = corner.position;
  EmitVertex();
}

void main() {
#if TRI_SCREEN_ALIGNED
  vec2 low;
  vec2 high;
  screen_bounds(particle_sphere[0], low, high);
  if (low.x > high.x || low.y > high.y) return;
#else
  Frame frame = sprite_frame(particle_sphere[0]);
#endif
#if TRI_COUNT
  add_count(TRI_COUNT_SPRITES, particle_id[0], 1u);
  add_count(TRI_COUNT_VERTICES, particle_id[0], 4u);
#endif
  for (int k = 0; k < 4; ++k) {
    vec2 side = vec2(k & 1, k >> 1) * 2.0 - 1.0;
#if TRI_SCREEN_ALIGNED
    emit(front_corner(particle_sphere[0], low, high, side));
#else
    emit(quad_corner(frame, side));
#endif
  }
  EndPrimitive();
}
