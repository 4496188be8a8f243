// Finds the nearest particle, small or large, that was drawn into this pixel, and writes its colour, id and depth.
TRI_BINDING(19) uniform usamplerBuffer id_texels;
layout(location = 0) out vec4 out_colour;
layout(location = 1) out uint out_id;

struct Shown {
  uvec2 keys;  // depth key and particle key
  vec4 sphere;
};

bool is_nearer(uvec2 a, uvec2 b) { return a.x > b.x || (a.x == b.x && a.y < b.y); }

// Returns the result of tiles_bin, tiles_index and tiles_resolve for this pixel.
Shown found(ivec2 pixel) {
  int place = pixel_index(pixel);
  uvec2 keys = uvec2(0u, TRI_NO_PARTICLE);
  if ((TRI_SPHERES & TRI_SMALL) != 0) {
    keys = uvec2(texelFetch(pixel_texels, place).x, texelFetch(pixel_texels, plane_size() + place).x);
  }
  if ((TRI_SPHERES & TRI_RESOLVED) != 0) {
    uvec4 state = tile_state(tile_index(pixel / TRI_TILE));
    uvec4 pair = imageLoad(large_pixels, ivec2(pixel.x, pixel.y / 2));
    uvec2 large = pixel.y % 2 == 0 ? pair.xy : pair.zw;
    bool drawn = state.x > 0u || (state.w & TRI_HAS_LARGE) != 0u;
    if (drawn && is_nearer(large, keys)) keys = large;
  }
  uint particle = min(particle_of_key(keys.y), u.counts.x - 1u);
  return Shown(keys, texelFetch(camera_texels, int(particle)));
}

// Tests the tile's entries (the large spheres that reach it), which no earlier pass has drawn. The bits for the
// quarters are ignored, because an entry that does not reach this quarter of the tile covers none of its pixels anyway.
// The loop's condition is at its end, as in next_entry().
Shown with_entries(Shown shown, ivec2 pixel) {
  vec2 s = pixel_ray(pixel);
  uvec4 state = tile_state(tile_index(pixel / TRI_TILE));
  uint at = state.y - state.x;
  do {
    bool is_entry = at < state.y;
    uint particle = is_entry ? particle_of(texelFetch(entry_texels, int(at)).x) : 0u;
    vec4 sphere = texelFetch(camera_texels, int(particle));
    uvec2 keys = uvec2(is_entry ? sphere_key(sphere, s) : 0u, particle_key(particle));
    if (is_nearer(keys, shown.keys)) shown = Shown(keys, sphere);
    ++at;
  } while (at < state.y);
  return shown;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Shown shown = Shown(uvec2(0u, TRI_NO_PARTICLE), vec4(0.0));
  if (TRI_SPHERES != TRI_LARGE) shown = found(pixel);
  if ((TRI_SPHERES & (TRI_LARGE | TRI_RESOLVED)) == TRI_LARGE) shown = with_entries(shown, pixel);
  if (shown.keys.x == 0u) discard;
  uint particle = min(particle_of_key(shown.keys.y), u.counts.x - 1u);
  vec4 c = shown.sphere;
  vec2 s = pixel_ray(pixel);
  float discriminant = tri_sphere_discriminant(c.x, c.y, c.z, c.w, s.x, s.y);
  float light = u.shading.x + u.shading.y * tri_sphere_cosine(c.w, s.x, s.y, max(discriminant, 0.0));
  vec4 stored = colour_at_vertex(stored_colour(particle));
  out_colour = vec4(light * colour_at_pixel(stored).rgb, 1.0);
  out_id = texelFetch(id_texels, int(particle)).x;
  gl_FragDepth = depth_of_key(shown.keys.x);
}
