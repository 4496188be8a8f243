// Computes the box around a sphere in world space. The injected fault 8 halves the radius.
void sphere_box(vec4 sphere, out vec3 lo, out vec3 hi) {
  float r = TRI_FAULT == 8 ? 0.5 * sphere.w : sphere.w;
  lo = vec3(tri_box_low(sphere.x, r), tri_box_low(sphere.y, r), tri_box_low(sphere.z, r));
  hi = vec3(tri_box_high(sphere.x, r), tri_box_high(sphere.y, r), tri_box_high(sphere.z, r));
}
