// Tests whether the ray hits the sphere. The driver invokes this shader if the ray may hit the
// sphere's box.
hitAttributeEXT uvec2 found;

void main() {
  uint particle = uint(gl_PrimitiveID);
  found = uvec2(candidate_key(particle, pixel_ray(ivec2(gl_LaunchIDEXT.xy) * ivec2(1, TRI_EVERY_ROW))),
                particle_key(particle));
#if TRI_COUNT
  add_count(TRI_COUNT_INTERSECTIONS, gl_LaunchIDEXT.y, 1u);
#endif
  if (found.x > 0u) reportIntersectionEXT(TRI_FAULT == 3 ? 1.0 : reported_distance(found.x), 0u);
}
