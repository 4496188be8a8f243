// Functions that find the nearest sphere along a ray, as a depth key and a particle key (keys.glsl). The driver may
// visit candidates in any order, and more than once. The distance reported to the driver depends only on the depth
// key. Hits with equal depths therefore have equal distances, and the driver does not discard one of them in favour
// of another. The reported distance lies behind the surface by 2⁻²⁰ of the distance, to allow for the rounding of
// near/depth.
TRI_BINDING(13) uniform samplerBuffer candidate_texels;  // spheres in world space, indexed by particle

vec3 ray_direction(vec2 s) { return u.forward.xyz + s.x * u.right.xyz + s.y * u.up.xyz; }

uint candidate_key(uint particle, vec2 s) {
  return sphere_key(camera_space(texelFetch(candidate_texels, int(particle))), s);
}

// With the injected fault 4, the distance is in front of the surface.
float reported_distance(uint depth) {
  float share = TRI_FAULT == 4 ? 0.5 : 1.000001;
  return share * u.eye.w / depth_of_key(depth);
}

bool comes_first(uvec2 a, uvec2 b) { return a.x > b.x || (a.x > 0u && a.x == b.x && a.y < b.y); }
