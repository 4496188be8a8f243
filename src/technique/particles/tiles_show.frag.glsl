// The nearest that was drawn into this pixel, small or large, and its colour.
TRI_BINDING(19) uniform usamplerBuffer id_texels;
layout(location = 0) out vec4 out_colour;
layout(location = 1) out uint out_id;

// Depth key and particle key.
uvec2 nearer(uvec2 a, uvec2 b) { return b.x > a.x || (b.x == a.x && b.y < a.y) ? b : a; }

uvec2 shown(ivec2 pixel) {
  int place = pixel_index(pixel);
  uvec2 small = uvec2(texelFetch(pixel_texels, place).x, texelFetch(pixel_texels, plane_size() + place).x);
  if (TRI_LARGE == 0) return small;
  uvec4 state = tile_state(tile_index(pixel / TRI_TILE));
  uvec4 pair = imageLoad(large_pixels, ivec2(pixel.x, pixel.y / 2));
  uvec2 large = pixel.y % 2 == 0 ? pair.xy : pair.zw;
  bool drawn = state.x > 0u || (state.w & TRI_HAS_LARGE) != 0u;
  return drawn ? nearer(small, large) : small;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec2 keys = shown(pixel);
  if (keys.x == 0u) discard;
  uint particle = min(particle_of_key(keys.y), u.counts.x - 1u);
  vec4 c = texelFetch(camera_texels, int(particle));
  vec2 s = pixel_ray(pixel);
  float discriminant = tri_sphere_discriminant(c.x, c.y, c.z, c.w, s.x, s.y);
  float light = u.shading.x + u.shading.y * tri_sphere_cosine(c.w, s.x, s.y, max(discriminant, 0.0));
  vec4 stored = colour_at_vertex(stored_colour(particle));
  out_colour = vec4(light * colour_at_pixel(stored).rgb, 1.0);
  out_id = texelFetch(id_texels, int(particle)).x;
  gl_FragDepth = depth_of_key(keys.x);
}
