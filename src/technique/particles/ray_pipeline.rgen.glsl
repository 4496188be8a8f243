// Traces one ray for each pixel.
TRI_BINDING(20) uniform accelerationStructureEXT structure;
layout(location = 0) rayPayloadEXT uvec2 best;

void main() {
  ivec2 pixel = ivec2(gl_LaunchIDEXT.xy) * ivec2(1, TRI_EVERY_ROW);
  if (pixel.x >= u.viewport.x || pixel.y >= u.viewport.y) return;
  vec2 s = pixel_ray(pixel);
  best = uvec2(0u, TRI_NO_PARTICLE);
  traceRayEXT(structure, gl_RayFlagsNoneEXT, 0xFFu, 0, 0, 0, u.eye.xyz, 0.0, ray_direction(s), 1.0e30, 0);
  int at = pixel_index(pixel);
  pixels[at] = best.x;
  pixels[plane_size() + at] = best.y;
}
