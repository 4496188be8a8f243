// The fragment stage of all sprite techniques. It intersects the ray through this pixel with the sphere.
// TRI_DEPTH_PROMISE, if defined, is the layout qualifier for conservative depth. Depth is reversed and the surface
// is behind the sprite, so the correct qualifier declares that depths are less than the sprite's. The opposite
// qualifier is an injected fault.
TRI_LINK(0) flat in vec4 sprite_sphere;  // in camera space
TRI_LINK(1) flat in vec4 sprite_colour;
TRI_LINK(2) flat in uint sprite_id;
TRI_LINK(3) in vec3 sprite_ray;

layout(location = 0) out vec4 out_colour;
layout(location = 1) out uint out_id;
#ifdef TRI_DEPTH_PROMISE
layout(TRI_DEPTH_PROMISE) out float gl_FragDepth;
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 s = TRI_RAY_AT_VERTEX == 1 ? sprite_ray.xy / sprite_ray.z : pixel_ray(pixel);
  vec4 c = sprite_sphere;
  float discriminant = tri_sphere_discriminant(c.x, c.y, c.z, c.w, s.x, s.y);
  float distance = discriminant >= 0.0 ? tri_sphere_distance(c.x, c.y, c.z, s.x, s.y, discriminant) : 0.0;
#if TRI_COUNT
  add_count(TRI_COUNT_FRAGMENTS, uint(pixel.y), 1u);
  if (!(distance > 0.0)) add_count(TRI_COUNT_DISCARDED, uint(pixel.y), 1u);
#endif
  if (!(distance > 0.0)) discard;
  float light = u.shading.x + u.shading.y * tri_sphere_cosine(c.w, s.x, s.y, discriminant);
  out_colour = vec4(light * colour_at_pixel(sprite_colour).rgb, 1.0);
  out_id = sprite_id;
  gl_FragDepth = tri_depth(u.eye.w, distance);
}
