// One invocation per pixel: colour, depth and id of what it shows.
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430) TRI_BINDING(13) writeonly buffer Picture { vec4 picture[]; };  // top row first

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel.x >= u.viewport.x || pixel.y >= u.viewport.y) return;
  uint place = pixel_index(pixel);
  uint depth = pixels[place];
  uint key = pixels[plane_size() + place];
  if (pixels[2u * plane_size() + place] == depth) key = min(key, pixels[3u * plane_size() + place]);
  vec4 colour = u.background;
  uint id = 0xFFFFFFFFu;
  if (depth > 0u) {
    uint particle = min(particle_of_key(key), u.counts.x - 1u);
    vec4 c = camera_space(spheres[particle]);
    vec2 s = pixel_ray(pixel);
    float discriminant = tri_sphere_discriminant(c.x, c.y, c.z, c.w, s.x, s.y);
    float light = u.shading.x + u.shading.y * tri_sphere_cosine(c.w, s.x, s.y, max(discriminant, 0.0));
    vec4 stored = colour_at_vertex(stored_colour(particle));
    colour = vec4(light * colour_at_pixel(stored).rgb, 1.0);
    id = ids[particle];
  }
  picture[place] = colour;
  pixels[place] = floatBitsToUint(depth_of_key(depth));
  pixels[plane_size() + place] = id;
}
