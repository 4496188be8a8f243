// Each invocation traces the ray of one pixel. With the injected fault 3 (reversed depth), hits do not shorten the
// ray.
layout(local_size_x = 8, local_size_y = 8) in;
TRI_BINDING(20) uniform accelerationStructureEXT structure;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) * ivec2(1, TRI_EVERY_ROW);
  if (pixel.x >= u.viewport.x || pixel.y >= u.viewport.y) return;
  vec2 s = pixel_ray(pixel);
  uvec2 best = uvec2(0u, TRI_NO_PARTICLE);
#if TRI_COUNT
  uint tested = 0u;
#endif
  rayQueryEXT query;
  rayQueryInitializeEXT(query, structure, gl_RayFlagsNoneEXT, 0xFFu, u.eye.xyz, 0.0, ray_direction(s), 1.0e30);
  while (rayQueryProceedEXT(query)) {
    uint particle = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
    uvec2 found = uvec2(candidate_key(particle, s), particle_key(particle));
#if TRI_COUNT
    ++tested;
#endif
    if (!comes_first(found, best)) continue;
    best = found;
    if (TRI_FAULT != 3) rayQueryGenerateIntersectionEXT(query, reported_distance(found.x));
  }
  int at = pixel_index(pixel);
  pixels[at] = best.x;
  pixels[plane_size() + at] = best.y;
#if TRI_COUNT
  add_count(TRI_COUNT_INTERSECTIONS, uint(pixel.y), tested);
#endif
}
