// The nearest large sphere among the entries of this pixel's tile. With TRI_SHOW also what was drawn before, the
// large spheres of earlier rounds (TRI_LARGE) and all small ones, and its colour.
#if TRI_SHOW
TRI_BINDING(19) uniform usamplerBuffer id_texels;
#if TRI_LARGE
TRI_BINDING(20) uniform sampler2D large_depth;
TRI_BINDING(21) uniform usampler2D large_particle;
#endif
layout(location = 0) out vec4 out_colour;
layout(location = 1) out uint out_id;
#else
layout(location = 0) out uint out_particle;  // its key
#endif

struct Shown {
  uint depth;     // keys
  uint particle;
};

Shown nearer(Shown a, uint depth, uint particle) {
  bool wins = depth > a.depth || (depth == a.depth && particle < a.particle);
  return Shown(wins ? depth : a.depth, wins ? particle : a.particle);
}

Shown with_entries(Shown shown, ivec2 pixel) {
  uvec4 state = tile_state(tile_index(pixel / TRI_TILE));
  for (uint at = state.y - state.x; at < state.y && state.x > 0u; ++at) {
    uint particle = texelFetch(entry_texels, int(at)).x;
    vec4 sphere = texelFetch(camera_texels, int(particle));
    shown = nearer(shown, sphere_key(sphere, pixel), particle_key(particle));
  }
  return shown;
}

#if TRI_SHOW
Shown drawn_before(ivec2 pixel) {
  int place = pixel_index(pixel);
  Shown shown = Shown(texelFetch(pixel_texels, place).x, texelFetch(pixel_texels, plane_size() + place).x);
#if TRI_LARGE
  shown = nearer(shown, depth_key(texelFetch(large_depth, pixel, 0).x), texelFetch(large_particle, pixel, 0).x);
#endif
  return shown;
}

void shade(uint particle_shown, ivec2 pixel) {
  int particle = int(min(particle_shown, u.counts.x - 1u));
  vec4 c = texelFetch(camera_texels, particle);
  vec2 s = pixel_ray(pixel);
  float discriminant = tri_sphere_discriminant(c.x, c.y, c.z, c.w, s.x, s.y);
  float light = u.shading.x + u.shading.y * tri_sphere_cosine(c.w, s.x, s.y, max(discriminant, 0.0));
  vec4 stored = colour_at_vertex(stored_colour(uint(particle)));
  out_colour = vec4(light * colour_at_pixel(stored).rgb, 1.0);
  out_id = texelFetch(id_texels, particle).x;
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
#if TRI_SHOW
  Shown shown = with_entries(drawn_before(pixel), pixel);
#else
  Shown shown = with_entries(Shown(0u, TRI_NO_PARTICLE), pixel);
#endif
  if (shown.depth == 0u) discard;
#if TRI_SHOW
  shade(particle_of_key(shown.particle), pixel);
#else
  out_particle = shown.particle;
#endif
  gl_FragDepth = depth_of_key(shown.depth);
}
