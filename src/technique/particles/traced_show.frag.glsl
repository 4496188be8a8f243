// Shades the sphere that a ray found for this pixel.
layout(location = 0) out vec4 out_colour;
layout(location = 1) out uint out_id;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int place = pixel.y * u.viewport.x + pixel.x;
  uint key = texelFetch(pixel_texels, place).x;
  if (key == 0u) discard;
  uint found = particle_of_key(texelFetch(pixel_texels, u.viewport.x * u.viewport.y + place).x);
  uint particle = min(found, u.counts.x - 1u);
  vec4 c = camera_space(texelFetch(sphere_texels, int(particle)));
  vec2 s = pixel_ray(pixel);
  float discriminant = tri_sphere_discriminant(c.x, c.y, c.z, c.w, s.x, s.y);
  float light = u.shading.x + u.shading.y * tri_sphere_cosine(c.w, s.x, s.y, max(discriminant, 0.0));
  vec4 stored = colour_at_vertex(stored_colour(particle));
  out_colour = vec4(light * colour_at_pixel(stored).rgb, 1.0);
  out_id = texelFetch(id_texels, int(particle)).x;
  gl_FragDepth = depth_of_key(key);
}
